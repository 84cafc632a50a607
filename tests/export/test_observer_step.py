"""The step of an observer in C and as StableHLO, against the observer itself."""

from __future__ import annotations

import ctypes
from pathlib import Path

import jax
import numpy as np
import pytest
from jax import export as jax_export

import acausal as ac
from examples.qvm.model import with_networks
from tests.support.exported_c import compile_c

ACCESS = """
#include "seen.h"
#include <stdlib.h>
seen *make(void) { seen *m = malloc(sizeof(seen)); seen_init(m); return m; }
int one_step(seen *m, double t, double u, const double *y) {
    m->t = (seen_real)t; m->u[0] = (seen_real)u;
    m->y[0] = (seen_real)y[0]; m->y[1] = (seen_real)y[1];
    return seen_step(m);
}
seen_real *mean_of(seen *m) { return m->mean; }
seen_real *covariance_of(seen *m) { return m->covariance; }
seen_real *values_of(seen *m) { return m->values; }
"""

Rows = list[tuple[float, float, np.ndarray]]

SENSORS = {"body.a": 0.2, "wheel.a": 1.0}


@pytest.fixture(scope="module")
def vehicle() -> ac.System:
    return ac.compile(with_networks())


def seen(system: ac.System, method: str) -> ac.Observer:
    deviations = {n: 0.1 if n.endswith(".v") else 0.005 for n in system.states}
    return ac.observer(
        system, SENSORS, {"body.v": 0.1, "body.m": 0.5}, 0.002, method=method, states=deviations,
        parameters={"body.m": 10.0},
    )  # fmt: skip


@pytest.fixture(scope="module")
def rows(vehicle: ac.System) -> Rows:
    """Time, input and measurements at times that are not even; some measurements are missing."""
    rng, t = np.random.default_rng(0), np.cumsum(np.tile([0.002, 0.003, 0.005], 60))
    u = 0.5 * np.sin(20 * t)
    run = ac.simulate(vehicle, (t[0], t[-1]), saveat=t, inputs={"road.v_ref": (t, u)})
    y = np.stack([run[n] + r * rng.standard_normal(len(t)) for n, r in SENSORS.items()], axis=1)
    y[::3, 0], y[1::4, 1] = np.nan, np.nan
    return list(zip(t.tolist(), u.tolist(), y, strict=True))


class InC:
    """An observer in C, compiled."""

    def __init__(self, observer: ac.Observer, folder: Path, number: type = float) -> None:
        header, source = ac.export.c(
            observer, folder, name="seen", outputs=["body.a"], dtype=np.dtype(number)
        )
        self.header, self.source = header.read_text(), source.read_text()
        access = folder / "access.c"
        access.write_text(ACCESS)
        compile_c([source, access], folder / "seen.so", f"-I{folder}")
        self.library = ctypes.CDLL(str(folder / "seen.so"))
        self.library.make.restype = ctypes.c_void_p
        self.m = ctypes.c_void_p(self.library.make())
        self.number = np.ctypeslib.as_ctypes_type(np.dtype(number))

    def view(self, field: str, shape: tuple[int, ...]) -> np.ndarray:
        function = getattr(self.library, f"{field}_of")
        function.restype = ctypes.POINTER(self.number)
        return np.ctypeslib.as_array(function(self.m), shape=shape)

    def step(self, t: float, u: float, y: np.ndarray) -> int:
        pointer = np.ascontiguousarray(y).ctypes.data_as(ctypes.c_void_p)
        return self.library.one_step(self.m, ctypes.c_double(t), ctypes.c_double(u), pointer)


@pytest.mark.cases(fast=0, slow=3)
@pytest.mark.parametrize("method", ["ekf", "ukf"])
def test_a_run_in_c_is_that_of_the_observer(
    vehicle: ac.System, rows: Rows, tmp_path: Path, method: str
):
    observer = seen(vehicle, method)
    in_c = InC(observer, tmp_path)
    assert "alloc(" not in in_c.source
    assert "body.v in m/s" in in_c.header
    for t, u, y in rows:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        assert in_c.step(t, u, y) == 0
    n = len(observer.mean)
    near = {"rtol": 1e-12, "atol": 1e-14}
    np.testing.assert_allclose(in_c.view("mean", (n,)), observer.mean, **near)
    np.testing.assert_allclose(in_c.view("covariance", (n, n)), observer.covariance, **near)
    assert in_c.view("values", (1,))[0] == pytest.approx(observer["body.a"], rel=1e-11)
    assert in_c.step(9.0, 0.0, np.full(2, np.inf)) == 1
    np.testing.assert_allclose(in_c.view("mean", (n,)), observer.mean, **near)


@pytest.mark.slow
def test_single_precision_is_near(vehicle: ac.System, rows: Rows, tmp_path: Path):
    observer = seen(vehicle, "ekf")
    in_c = InC(observer, tmp_path, np.float32)
    for t, u, y in rows[:50]:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        assert in_c.step(t, u, y) == 0
    n = len(observer.mean)
    off = (in_c.view("mean", (n,)) - observer.mean) / list(observer.deviations.values())
    assert np.max(np.abs(off)) < 0.05


@pytest.mark.slow
def test_stablehlo_has_the_same_step(vehicle: ac.System, rows: Rows, tmp_path: Path):
    observer = seen(vehicle, "ekf")
    path = ac.export.stablehlo(observer, tmp_path / "seen.jax", derivatives=0)
    step = jax.jit(jax_export.deserialize(bytearray(path.read_bytes())).call)
    start = observer.step_of_arrays.start
    memory = tuple(start)
    for t, u, y in rows[:20]:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        memory = step(t, np.array([u]), y, *memory)
    np.testing.assert_allclose(memory[2], observer.mean, rtol=1e-12, atol=1e-14)


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("method", ["ekf", "ukf"])
def test_onnx_has_the_same_step(vehicle: ac.System, rows: Rows, tmp_path: Path, method: str):
    onnxruntime = pytest.importorskip("onnxruntime")
    observer = seen(vehicle, method)
    path = ac.export.onnx(observer, tmp_path / "seen.onnx", outputs=["body.a"])
    options = onnxruntime.SessionOptions()
    options.log_severity_level = 3
    session = onnxruntime.InferenceSession(str(path), options)
    given = ("t_before", "u_before", "mean", "covariance")
    found = [np.asarray(a) for a in observer.step_of_arrays.start]
    for t, u, y in rows[:20]:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        known = dict(zip(given, found, strict=False))
        found = session.run(None, {"t": np.asarray(t), "u": np.array([u]), "y": y, **known})
    assert [o.name for o in session.get_outputs()][2:4] == ["mean_after", "covariance_after"]
    np.testing.assert_allclose(found[2], observer.mean, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found[3], observer.covariance, rtol=1e-9, atol=1e-12)
    assert found[4][0] == pytest.approx(observer["body.a"], rel=1e-9)


def test_what_an_observer_has_already_is_refused(vehicle: ac.System, tmp_path: Path):
    observer = seen(vehicle, "ekf")
    with pytest.raises(ac.DataError, match=r"export\.c: an observer has its own parameters"):
        ac.export.c(observer, tmp_path, solver="euler")
    with pytest.raises(ac.DataError, match="of an observer only outputs can be named"):
        ac.export.stablehlo(observer, tmp_path / "seen.mlir", parameters=True)
