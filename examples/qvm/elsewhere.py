"""The exported vehicle in other people's tools: what each computes, how fast, and how far it is from acausal."""

from __future__ import annotations

import ctypes
import importlib
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import jax
import numpy as np

import acausal as ac
from examples.qvm.record import INPUT, SAMPLE_TIME

SHOWN = ("body.s", "body.v", "body.a", "wheel.s")
"""What trajectories are compared by."""
RISE, END = 0.1, 2.0
"""The road rises at this speed [m/s] for so long [s]; the vehicle starts at rest."""
TIMES = np.linspace(0.0, END, 201)
POINTS, ROUNDS, TURN = 50, 15, 0.02
"""Points at which rates are compared; how often a call is timed, and for how many seconds each time, about."""


class MissingError(Exception):
    """A tool is not installed; the text is a sentence."""


@dataclass(frozen=True)
class Row:
    """A line of the table.

    Attributes:
        form: what was exported, and who read it. size: of the file or files, in bytes.
        seconds: of one evaluation of the rates, or of one step.
        difference: to acausal, relative to the largest value. of: what was compared.
    """

    form: str
    size: int | None
    seconds: float | None
    difference: float
    of: str


@dataclass(frozen=True, eq=False)
class Vehicle:
    """The trained vehicle as acausal computes it, and the folder of its exports.

    Attributes:
        folder: holds ``vehicle.fmu`` and so on, see `examples.qvm.ship`.
    """

    system: ac.System
    params: dict[str, Any]
    folder: Path

    @cached_property
    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """States (n, n_states) and inputs (n, n_inputs) of the size of a ride."""
        size = np.array([0.02 if name.endswith(".s") else 0.3 for name in self.system.states])
        draw = np.random.default_rng(0).normal
        return draw(size=(POINTS, len(size))) * size, draw(size=(POINTS, 1)) * 0.3

    @cached_property
    def field(self) -> Callable[..., Any]:
        packed = self.system.pack(self.params)
        return jax.jit(lambda t, x, u: self.system.vector_field(t, x, u, packed))

    @cached_property
    def rates(self) -> np.ndarray:
        """At the points, shape (n, n_states)."""
        return np.stack([self.field(0.0, x, u) for x, u in zip(*self.points, strict=True)])

    def off(self, rates: Callable[[np.ndarray, np.ndarray], Any]) -> float:
        """How far another function of states and inputs is from `rates`."""
        found = np.stack([np.ravel(rates(x, u)) for x, u in zip(*self.points, strict=True)])
        return float(
            (np.abs(found - self.rates).max(axis=0) / np.abs(self.rates).max(axis=0)).max()
        )

    @cached_property
    def exact(self) -> ac.Solution:
        """The rise of the road, with tight tolerances."""
        return self._simulated(rtol=1e-11, atol=1e-13)

    @cached_property
    def stepped(self) -> ac.Solution:
        """The same in the fixed steps of the exports."""
        return self._simulated(dt=SAMPLE_TIME, solver="rk4")

    def _simulated(self, **how: Any) -> ac.Solution:
        return ac.simulate(
            self.system, (0.0, END), saveat=TIMES, inputs={INPUT: RISE}, params=self.params, **how
        )

    def apart(self, other: Callable[[str], Any], own: ac.Solution) -> float:
        """How far trajectories of another tool, by name, are from acausal's."""
        return max(
            float(np.abs(np.asarray(other(n)) - own[n]).max() / np.abs(own[n]).max()) for n in SHOWN
        )

    def path(self, ending: str) -> Path:
        return self.folder / f"vehicle{ending}"

    def size(self, *endings: str) -> int:
        return sum(self.path(ending).stat().st_size for ending in endings)


def need(name: str) -> Any:
    """A package."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingError(
            f"{name} is not installed (pip install 'acausal[export,export-proof]')."
        ) from None


def need_compiler() -> str:
    """The C compiler; without one the FMUs hold sources only, too."""
    found = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if found is None:
        raise MissingError("There is no C compiler.")
    return found


def timed(call: Callable[[], Any], calls: int = 1) -> float:
    """Seconds of one call: the best of some rounds. ``calls``: how many ``call`` makes."""
    call()
    begin = time.perf_counter()
    call()
    repeat = max(1, int(TURN / max(time.perf_counter() - begin, 1e-9)))
    found: list[float] = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        for _ in range(repeat):
            call()
        found.append((time.perf_counter() - begin) / repeat / calls)
    return min(found)


# -- tools -------------------------------------------------------------------------------------------


def acausal(vehicle: Vehicle) -> list[Row]:
    """Python itself, for comparison."""
    x, u = (a[0] for a in vehicle.points)
    seconds = timed(lambda: jax.block_until_ready(vehicle.field(0.0, x, u)))
    return [Row("acausal, jax.jit", None, seconds, 0.0, "rates")]


DRIVER = """
#include "vehicle.h"
#include <stdlib.h>
vehicle *make(void) { vehicle *m = calloc(1, sizeof(vehicle)); if (m) vehicle_init(m); return m; }
int rates(vehicle *m, const double *x, const double *u, double *dx, int n) {
  int failed = 0;
  for (int i = 0; i < VEHICLE_STATES; i++) m->x[i] = x[i];
  m->u[0] = u[0];
  for (int i = 0; i < n; i++) failed |= (int)vehicle_derivatives(m);
  for (int i = 0; i < VEHICLE_STATES; i++) dx[i] = m->dx[i];
  return failed;
}
int ride(vehicle *m, double rise, double h, int n, int every, double *y) {
  int failed = 0;
  vehicle_init(m);
  m->u[0] = rise;
  for (int i = 0; i <= n; i++) {
    if (i % every == 0) {
      failed |= (int)vehicle_outputs(m);
      for (int k = 0; k < VEHICLE_OUTPUTS; k++) *y++ = m->y[k];
    }
    failed |= (int)vehicle_step(m, h, NULL);
  }
  return failed;
}
"""
CALLS = 1000


def compiled_c(vehicle: Vehicle) -> list[Row]:
    """The C, compiled here: rates in a loop, and a simulation in its own steps."""
    compiler = need_compiler()
    driver, library = vehicle.folder / "driver.c", vehicle.folder / "vehicle.so"
    driver.write_text(DRIVER)
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC"]
    command = [compiler, *flags, vehicle.path(".c"), driver, "-o", library, "-lm"]
    subprocess.run([str(part) for part in command], check=True)
    loaded = ctypes.CDLL(str(library.resolve()))
    loaded.make.restype = ctypes.c_void_p
    m = ctypes.c_void_p(loaded.make())
    dx = np.zeros(len(vehicle.system.states))

    def rates(x: np.ndarray, u: np.ndarray, n: int = 1) -> np.ndarray:
        assert loaded.rates(m, *_pointers(x, u, dx), n) == 0
        return dx.copy()

    x, u = (a[0] for a in vehicle.points)
    seconds = timed(lambda: rates(x, u, CALLS), CALLS)
    every = round((TIMES[1] - TIMES[0]) / SAMPLE_TIME)
    steps = every * (len(TIMES) - 1)
    y = np.zeros((len(TIMES), len(SHOWN)))

    def ride() -> None:
        numbers = ctypes.c_double(RISE), ctypes.c_double(SAMPLE_TIME)
        assert loaded.ride(m, *numbers, steps, every, *_pointers(y)) == 0

    of_step = timed(ride, steps)
    size = vehicle.size(".c", ".h")
    apart = vehicle.apart(lambda n: y[:, SHOWN.index(n)], vehicle.stepped)
    return [
        Row("C: derivatives", size, seconds, vehicle.off(rates), "rates"),
        Row("C: step of rk4", size, of_step, apart, "simulation"),
    ]


def _pointers(*arrays: np.ndarray) -> list[ctypes.c_void_p]:
    return [a.ctypes.data_as(ctypes.c_void_p) for a in arrays]


def in_fmpy(vehicle: Vehicle) -> list[Row]:
    """The FMUs: model exchange by CVode, and co-simulation."""
    need_compiler()
    fmpy = need("fmpy")
    rows: list[Row] = []
    for fmi, ending in (("3.0", ".fmu"), ("2.0", "_fmi2.fmu")):
        path = str(vehicle.path(ending))
        size, seconds = vehicle.size(ending), _fmu_rates(fmpy, vehicle, path)
        for kind, own in (("ModelExchange", vehicle.exact), ("CoSimulation", vehicle.stepped)):
            result = fmpy.simulate_fmu(
                path, fmi_type=kind, stop_time=END, output_interval=TIMES[1], relative_tolerance=1e-10,
                start_values={INPUT: RISE}, output=SHOWN,
            )  # fmt: skip
            exchange = kind == "ModelExchange"
            name = f"FMU {fmi}, {'CVode' if exchange else 'co-simulation'}"
            at = np.abs(result["time"][:, None] - TIMES).argmin(axis=0)  # events have rows, too
            apart = vehicle.apart(result[at].__getitem__, own)
            rows.append(Row(name, size, seconds if exchange else None, apart, "simulation"))
    return rows


def _fmu_rates(fmpy: Any, vehicle: Vehicle, path: str) -> float:
    """Seconds of one evaluation through the functions of FMI, as called from Python."""
    folder = str(fmpy.extract(path))
    try:
        description = fmpy.read_model_description(folder)
        fmu = fmpy.instantiate_fmu(folder, description, "ModelExchange")
        if description.fmiVersion == "2.0":
            fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        fmu.enterContinuousTimeMode()
        x, dx = vehicle.points[0][0].copy(), np.zeros(len(vehicle.system.states))
        real = ctypes.POINTER(ctypes.c_double)
        at, result = x.ctypes.data_as(real), dx.ctypes.data_as(real)
        get = (
            fmu.getDerivatives
            if description.fmiVersion == "2.0"
            else fmu.getContinuousStateDerivatives
        )

        def evaluate() -> None:
            fmu.setContinuousStates(at, len(x))
            get(result, len(x))

        seconds = timed(evaluate)
        fmu.terminate()
        fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return seconds


def in_casadi(vehicle: Vehicle) -> list[Row]:
    """The FMU as a function that CasADi differentiates."""
    need_compiler()
    casadi, fmpy = need("casadi"), need("fmpy")
    folder = str(fmpy.extract(str(vehicle.path(".fmu"))))
    try:
        function = casadi.DaeBuilder("vehicle", folder).create("rates", ["x", "u"], ["ode"])
        jacobian = function.factory("jacobian", ["x", "u"], ["jac:ode:x"])
        x, u = (a[0] for a in vehicle.points)
        there = ac.linearize(vehicle.system, x=x, inputs=u, params=vehicle.params).A
        apart = np.abs(np.array(jacobian(x, u)) - there).max() / np.abs(there).max()
        seconds, off = (
            timed(lambda: function(x, u)),
            vehicle.off(lambda x, u: np.array(function(x, u))),
        )
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    size = vehicle.size(".fmu")
    return [
        Row("FMU 3.0, CasADi", size, seconds, off, "rates"),
        Row("FMU 3.0, CasADi", size, None, float(apart), "Jacobian"),
    ]


def in_onnxruntime(vehicle: Vehicle) -> list[Row]:
    """The right-hand side as an ONNX graph."""
    onnxruntime = need("onnxruntime")
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    session = onnxruntime.InferenceSession(str(vehicle.path(".onnx")), options)
    time_zero = np.array(0.0)

    def rates(x: np.ndarray, u: np.ndarray) -> Any:
        return session.run(["der(x)"], {"t": time_zero, "x": x, "u": u})[0]

    x, u = (a[0] for a in vehicle.points)
    size = vehicle.size(".onnx")
    return [Row("ONNX, onnxruntime", size, timed(lambda: rates(x, u)), vehicle.off(rates), "rates")]


def in_jax(vehicle: Vehicle) -> list[Row]:
    """StableHLO, read by JAX without acausal."""
    need("flatbuffers")
    again = jax.export.deserialize(bytearray(vehicle.path(".jax").read_bytes()))
    call = jax.jit(lambda x, u: again.call(np.array(0.0), x, u)[0])
    x, u = (a[0] for a in vehicle.points)
    seconds = timed(lambda: jax.block_until_ready(call(x, u)))
    return [Row("StableHLO, jax.export", vehicle.size(".jax"), seconds, vehicle.off(call), "rates")]


def in_rumoca(vehicle: Vehicle) -> list[Row]:
    """The Modelica text, compiled and simulated by rumoca."""
    rumoca = need("rumoca")
    text = vehicle.path(".mo").read_text()
    feed = f"equation m.{INPUT.replace('.', '_')} = {RISE};"
    text += f"model Run\n  vehicle.QuarterVehicle m;\n{feed}\nend Run;\n"
    config = rumoca.SimConfig(rtol=1e-11, atol=1e-13)
    found = rumoca.Session().loads(text, model="Run").simulate(END, dt=TIMES[1], config=config)
    apart = vehicle.apart(lambda n: found[f"m.{n}"], vehicle.exact)
    return [Row("Modelica, rumoca", vehicle.size(".mo"), None, apart, "simulation")]


TOOLS: dict[str, Callable[[Vehicle], list[Row]]] = {
    "timing acausal itself": acausal,
    "compiling the C": compiled_c,
    "running the FMUs in fmpy": in_fmpy,
    "reading the FMU in CasADi": in_casadi,
    "running the ONNX file": in_onnxruntime,
    "reading the StableHLO file": in_jax,
    "compiling the Modelica text": in_rumoca,
}
"""What is done, for progress, and by which function."""
