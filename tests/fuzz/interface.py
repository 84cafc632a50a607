"""Slips at the interface: every public function and method, called with a value of a wrong kind for an argument."""

from __future__ import annotations

import contextlib
import functools
import inspect
import math
import random
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import sympy as sp

import acausal as ac
from acausal.components import translational as tl

from .calls import Case, Oddity, case
from .outcome import Mutant

HOMES = (ac, ac.export)
"""Where the public functions and classes are."""

FURTHER = {
    "mpc": ac.control.mpc,
    "Law": ac.networks.Law,
    "Energy": ac.networks.Energy,
    "Fourier": ac.networks.Fourier,
}
"""Those of rooms that have others besides."""

VALUES: dict[str, Callable[[Case], Any]] = {
    "none": lambda c: None,
    "a truth value": lambda c: True,
    "zero": lambda c: 0,
    "a negative number": lambda c: -1,
    "a fraction": lambda c: 1.5,
    "NaN": lambda c: math.nan,
    "a huge number": lambda c: 10**400,
    "a complex number": lambda c: 1j,
    "NumPy's number": lambda c: np.int32(2),
    "NumPy's truth value": lambda c: np.bool_(True),
    "an empty text": lambda c: "",
    "a text": lambda c: "q",
    "a digit": lambda c: "1",
    "bytes": lambda c: b"q",
    "an empty list": lambda c: [],
    "a list of numbers": lambda c: [1, 2, 3],
    "a mixed list": lambda c: [1, "a", None],
    "an empty mapping": lambda c: {},
    "a mapping of numbers": lambda c: {3: 4},
    "a mapping of names": lambda c: {c.state: "q"},
    "a mapping of arrays": lambda c: {c.state: np.zeros(3)},
    "a mapping of classes": lambda c: {c.parameter: ac.Bounded, c.input: ac.Signal},
    "an array": lambda c: np.zeros(3),
    "an array of texts": lambda c: np.array(["a", "b"]),
    "an array of objects": lambda c: np.array([None, object()]),
    "a date": lambda c: np.datetime64("2020-01-01"),
    "an object": lambda c: Oddity(),
    "a class": lambda c: ac.Data,
    "a function of nothing": lambda c: lambda: None,
    "a system": lambda c: c.system,
    "a model": lambda c: c.system.model,
    "a record": lambda c: c.data,
    "an expression": lambda c: ac.time,
    "a key": lambda c: jax.random.key(0),
}
"""By name, a value that most arguments cannot be."""

SOUND: dict[str, Callable[[Case], Any]] = {
    "system": lambda c: c.system,
    "model": lambda c: c.system,
    "data": lambda c: c.data,
    "records": lambda c: c.data,
    "targets": lambda c: c.state,
    "modifiers": lambda c: [c.parameter],
    "inputs": lambda c: {c.input: 0.5},
    "epochs": lambda c: 1,
    "strategy": lambda c: "whole_record",
    "progress": lambda c: False,
    "members": lambda c: 2,
    "folds": lambda c: 2,
    "params": lambda c: c.system.parameters(),
    "over": lambda c: {c.parameter: [1.0, 2.0]},
    "t": lambda c: (0.0, 0.2),
    "dt": lambda c: 0.1,
    "path": lambda c: "file",
    "folder": lambda c: "folder",
    "network": lambda c: ac.networks.Law(width=2, depth=1)(0),
    "net": lambda c: ac.networks.Law(width=2, depth=1)(0),
    "operating_point": lambda c: "steady",
    "low": lambda c: 0.5,
    "high": lambda c: 2.0,
    "key": lambda c: 0,
    "ranges": lambda c: {c.parameter: (1.0, 2.0)},
    "q": lambda c: ac.time,
    "name": lambda c: c.state,
    "names": lambda c: [c.state],
    "sensors": lambda c: {c.state: 0.01},
    "noise": lambda c: {c.second: 0.1},
    "states": lambda c: {c.state: 0.1},
    "track": lambda c: {c.state: 1.0},
    "effort": lambda c: {c.input: 0.1},
    "steps": lambda c: 4,
    "sample_time": lambda c: 0.1,
    "omega": lambda c: [1.0, 2.0],
    "parameter": lambda c: c.parameter,
    "u": lambda c: {c.input: 0.5},
    "y": lambda c: {c.state: 0.0},
    "x": lambda c: np.zeros(2),
    "start": lambda c: 0.2,
    "end": lambda c: 0.8,
    "points": lambda c: f"{c.input}",
    "indices": lambda c: {c.parameter: 0},
    "values": lambda c: {c.parameter: 1.0},
}
"""By the name of an argument, what is right for it where another argument is wrong."""

SOUND_OF: dict[str, dict[str, Callable[[Case], Any]]] = {
    "compile": {"model": lambda c: tl.Mass(m=1.0), "inputs": lambda c: ()},
    "save": {"model": lambda c: c.system.model},
    "sliders": {"params": lambda c: None},
    "linearize": {"inputs": lambda c: {c.input: 0.5}},
    "cross_validate": {"epochs": lambda c: 1},
    "Energy": {"inputs": lambda c: 1},
    "FMU": {"path": lambda c: fmu(), "values": lambda c: {}},
    "load": {"file": lambda c: saved(), "path": lambda c: ()},
    "Component.replace": {"path": lambda c: "spring", "part": lambda c: tl.Spring(c=1.0)},
    "Fit.export": {"path": lambda c: "trained.mo"},
    "Fit.profile": {"points": lambda c: 5},
    "Linearization.lqr": {"inputs": lambda c: {c.input: 0.1}},
    "System.observe": {"t": lambda c: 0.0, "u": lambda c: [0.5]},
    "System.vector_field": {"t": lambda c: 0.0, "u": lambda c: [0.5]},
    "Observer.step": {"t": lambda c: 0.0},
    "MPC.step": {"x": lambda c: {c.state: 0.0, c.second: 0.0}},
}
"""The same for single functions."""


def fitted(**options: Any) -> None:
    """A training with an object that a slip has made."""
    c = case("translational")
    given = {"strategy": "whole_record", "epochs": 1, "progress": False, "modifiers": [c.parameter]}
    ac.fit(c.system, c.data, c.state, **{**given, **options})


def declared(made: Any) -> None:
    """A model whose class has a declaration that a slip has made."""

    def equations(self: Any) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), 1.0)

    parts = {"x": ac.Variable(), "extra": made, "equations": equations}
    ac.compile(type("Declared", (ac.Component,), parts)()).parameters()


USES: dict[str, Callable[[Case, Any], Any]] = {
    **dict.fromkeys(
        ("Parameter", "Variable", "Potential", "Flow", "Input", "Output", "Discrete", "Option", "InitialParameter",
         "Module"),
        lambda c, made: declared(made),
    ),
    **dict.fromkeys(("Shift", "Bounded"), lambda c, made: fitted(modifiers={c.parameter: made})),
    **dict.fromkeys(
        ("FrequencyRange", "DampingRatio", "Stability", "SmallCorrection", "ZeroCrossing"),
        lambda c, made: fitted(regularizers=[made]),
    ),
    **dict.fromkeys(("Huber", "Student", "Likelihood"), lambda c, made: fitted(loss=made)),
    "Delay": lambda c, made: fitted(delays={c.input: made}),
    "Lag": lambda c, made: fitted(lags={c.input: made}),
    "Start": lambda c, made: ac.compile(tl.Mass(m=1.0, s=made)),
}  # fmt: skip
"""By class, how an object of it is used: what it does not check when it is made, it must then."""

METHODS: dict[str, tuple[Callable[[Case], Any], str]] = {
    "Component": (lambda c: tl_model(), "connect is_given modify replace"),
    "System": (lambda c: c.system, "initial_state initialize observe pack parameters table unit vector_field"),
    "Data": (
        lambda c: c.data,
        "__getitem__ between select signal of stream from_csv from_dataframe from_files from_mat from_mdf from_xarray",
    ),
    "Signal": (lambda c: ac.Signal([0.0, 1.0], [1.0, 2.0]), "__call__ delayed differentiated"),
    "Solution": (lambda c: solution(), "__getitem__ animation plot to_csv to_dataframe to_dict to_xarray unit"),
    "Sweep": (
        lambda c: ac.sweep(c.system, {c.parameter: [1.0, 2.0]}, 0.2, inputs={c.input: 0.5}, dt=0.1),
        "__getitem__ isel sel plot to_xarray unit",
    ),
    "Estimation": (
        lambda c: ac.estimate(c.system, c.data, sensors=SOUND["sensors"](c), noise=SOUND["noise"](c)),
        "__getitem__ animation deviation plot smooth to_csv to_dict",
    ),
    "Observer": (
        lambda c: ac.observer(c.system, SOUND["sensors"](c), SOUND["noise"](c), 0.1),
        "step",
    ),
    "Linearization": (
        lambda c: ac.linearize(c.system, inputs={c.input: 0.5}),
        "bode frequency_response kalman lqr nyquist step step_response",
    ),
    "OperatingPoint": (
        lambda c: ac.operating_point(c.system, inputs={c.input: 0.5}),
        "__getitem__ to_dict unit",
    ),
    "Fit": (
        lambda c: trained(),
        "confidence conformal distill evaluate export predict profile report residuals samples",
    ),
    "Predictions": (lambda c: trained().predict(c.data), "__getitem__ report"),
    "Prediction": (lambda c: trained().predict(c.data)["record"], "to_csv"),
    "Diagram": (lambda c: ac.diagram(c.system), "save"),
    "MPC": (
        lambda c: ac.control.mpc(c.system, dt=0.1, steps=4, track=SOUND["track"](c), effort=SOUND["effort"](c)),
        "reset run step",
    ),
}  # fmt: skip
"""By class, an object of it and the methods that users call."""


def tl_model() -> ac.Component:
    return ac.load(saved())


@functools.cache
def saved() -> str:
    """A file with the model."""
    path = Path(tempfile.mkdtemp(prefix="interface"), "model.json")
    ac.save(case("translational").system.model, path)
    return str(path)


@functools.cache
def fmu() -> str:
    """An FMU of the model."""
    path = Path(saved()).with_name("model.fmu")
    return str(ac.export.fmu(case("translational").system, path))


@functools.cache
def solution() -> ac.Solution:
    return ac.simulate(
        case("translational").system, (0.0, 0.5), dt=0.1, inputs={case("translational").input: 0.5}
    )


@functools.cache
def trained() -> ac.Fit:
    c = case("translational")
    options = {"strategy": "whole_record", "epochs": 1, "progress": False}
    return ac.fit(c.system, c.data, c.state, modifiers=[c.parameter], **options)


@functools.cache
def made_object(name: str) -> Any:
    return METHODS[name][0](case("translational"))


def method(cls: str, name: str) -> Callable[..., Any]:
    """A method of a made object, with its signature; the object is made when it is called."""
    known = {"MPC": ac.control.MPC, "Signal": ac.Signal}
    defined = inspect.getattr_static(known.get(cls) or getattr(ac, cls), name)

    def call(*given: Any, **named: Any) -> Any:
        found = made_object(cls) if cls != "Component" else tl_model()
        return getattr(found, name)(*given, **named)

    inner = getattr(defined, "__func__", defined)
    _, *others = inspect.signature(inner).parameters.values()
    call.__signature__ = inspect.Signature(others)  # type: ignore[attr-defined]
    return call


RESULTS = frozenset([
    "CrossValidation", "Diagram", "Distilled", "Ensemble", "Estimation", "Fit", "Formula", "Initialization",
    "Linearization", "Observer", "OpenLoop", "OperatingPoint", "Prediction", "Predictions", "Profile",
    "RecordFit", "Solution", "Stability", "Sweep", "System",
])  # fmt: skip
"""Classes of which no user makes objects."""


def _made() -> Iterator[tuple[str, Callable[..., Any]]]:
    """The functions, and the classes that users call, each once."""
    for home in HOMES:
        for name in sorted(dir(home)):
            found = getattr(home, name)
            an_error = inspect.isclass(found) and issubclass(found, Exception | sp.Function)
            sympys = str(getattr(found, "__module__", "")).startswith(
                "sympy"
            )  # which say what is wrong themselves
            if callable(found) and not (
                name.startswith("_") or name in RESULTS or an_error or sympys
            ):
                yield name, found
    yield from FURTHER.items()
    for cls, (_, names) in METHODS.items():
        for name in names.split():
            yield f"{cls}.{name}", method(cls, name)


def _arguments(function: Callable[..., Any]) -> list[inspect.Parameter]:
    try:
        found = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return []
    return [p for p in found if p.kind is not p.VAR_KEYWORD]


@functools.cache
def slips() -> tuple[tuple[str, Callable[..., Any], str, str], ...]:
    """Function, argument and value of every slip, in an order by chance."""
    found = [
        (name, function, p.name, value)
        for name, function in _made()
        for p in _arguments(function)
        for value in VALUES
    ]
    return tuple(random.Random("interface").sample(found, len(found)))


def mutant(seed: int, folder: Path) -> Mutant:
    """The slip of a seed."""
    name, function, wrong, value = slips()[seed]
    c = case("translational")

    def make() -> Any:
        sound = {n: of(c) for n, of in {**SOUND, **SOUND_OF.get(name, {})}.items()}
        before = jax.config.jax_compilation_cache_dir  # type: ignore[attr-defined]
        given, named = [], {}
        for p in _arguments(function):
            is_wrong, needed = (
                p.name == wrong,
                p.default is p.empty and p.kind is not p.VAR_POSITIONAL,
            )
            if is_wrong or needed or (p.kind is p.KEYWORD_ONLY and p.name in sound):
                argument = VALUES[value](c) if is_wrong else sound.get(p.name, 1.0)
                if p.kind is not p.KEYWORD_ONLY and not named:
                    given.append(argument)
                else:
                    named[p.name] = argument
            elif p.kind is p.POSITIONAL_OR_KEYWORD:
                given.append(p.default)
        try:
            with contextlib.chdir(folder):
                made = function(*given, **named)
                return USES.get(name, lambda c, made: made)(c, made)
        finally:
            jax.config.update("jax_compilation_cache_dir", before)

    return Mutant(seed, "interface", name, f"{name}({wrong}={value})", ("",), False, make)
