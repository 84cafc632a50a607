"""`c`: a model's differential equations, or an observer's step, as C."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from acausal._jax import need_known, precision
from acausal.analysis import Observer
from acausal.errors import DataError, shown
from acausal.export.c_text.code import write_code
from acausal.export.c_text.header import header
from acausal.export.c_text.source import source
from acausal.export.c_text.steps import scheme_named
from acausal.export.c_text.target_text import target_header, target_source, target_text
from acausal.export.c_text.text import ModelText
from acausal.export.names import NameRange, runs
from acausal.export.needs import all_parameters, need_exportable
from acausal.export.ranges import Ranges, Watch, watched
from acausal.export.target import target_of
from acausal.export.vector import ParameterVector
from acausal.files import need_path, write_files
from acausal.modeling import names_in
from acausal.simulation import limits_of
from acausal.system import System

_KEYWORDS = """auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while main"""

_MATH = """acos asin atan atan2 ceil cos cosh exp expm1 fabs floor fmax fmin fmod hypot isfinite isinf isnan log log1p
nearbyint pow remainder round signbit sin sinh sqrt tan tanh tgamma lgamma erf erfc cbrt trunc real"""

_OWN = """all_finite attempt begin_modes came_true condition_rates conditions copy discrete_starts end_with_event equal
excess factor fill_d fill_p fill_x find_due find_edge find_modes find_states fire force guesses is_ahead is_reset
iterate jacobian_column jumped look look_at_points limits lu_factor lu_solve maximum minimum next_length once_more
outputs rates recalibrate resets same signum solve_stage starts strict switched tangent ticks timed updated
within_limits x u y p d t m h Model Status"""

RESERVED = frozenset(f"{_KEYWORDS} {_MATH} {_OWN}".split())
"""Words of C, of its mathematics, and of the functions in a model's file."""


PRECISION = {"float64": "double", "float32": "float"}
"""Numbers of C by numbers of NumPy."""


def c(
    model: System | Observer,
    folder: str | Path,
    params: Mapping[str, Any] | None = None,
    *,
    name: str | None = None,
    outputs: Sequence[str] | None = None,
    solver: str = "rk4",
    derivatives: bool = True,
    dtype: Any = np.float64,
    ranges: Ranges | None = None,
) -> tuple[Path, Path]:
    """Write a model's equations, or an observer's step, as C99: a header and a source, without heap or static memory.

    Networks, wrappers and Newton's method for algebraic loops are part of it; arrays of components are loops. The
    header says how to use it. Start values that follow from parameters or inputs are computed there, too, unless they
    need an operation without C or much memory; a warning names them, and the header says so.

    An observer's step is one function of one struct: time, inputs and measurements go in, and it remembers the rest, as
    `Observer.step` does.

    Arguments:
        model: a compiled model, or an observer, which has its parameters and its steps already: of the other arguments
            it takes ``name``, ``outputs`` and ``dtype``.
        folder: where the files are written; it is made if need be.
        params: as `System.parameters` gives them, for example ``fit.params``; by default the model's.
        name: of files, struct and functions; by default the model's class in small letters.
        outputs: names of the variables to compute besides the derivatives; by default the model's states. Of an
            observer those to estimate besides what it remembers; by default none.
        solver: of the fixed steps, by its name in `acausal.simulate`; for stiff models one of ``"implicit_euler"``,
            ``"kvaerno3"``, ``"kvaerno4"``, ``"kvaerno5"``.
        derivatives: whether directional derivatives by time, states, inputs and parameters are written.
        dtype: ``numpy.float64`` or ``numpy.float32``.
        ranges: by network the interval of its argument in training, or one for each argument, such as ``fit.ranges``:
            the function ``..._outside`` tells whether an argument has left its range.

    Returns:
        The paths of header and source.

    Raises:
        DataError: for an unknown name, what is no path, or an argument that does not fit.
        ExportError: for an operation without C, or a solver that has no fixed steps in C.
    """
    if isinstance(model, Observer):
        if (params, ranges, solver, derivatives) != (None, None, "rk4", True):
            raise DataError(
                "export.c: an observer has its own parameters and steps; give them to ac.observer."
            )
        target = target_of(model, None, None, None, outputs or (), None, False, "c")
        real = PRECISION[precision(dtype).name]
        observed = target_text(target, _name(target.title.replace(" ", "_"), name), real)
        parts = observed.name, target_header(observed), target_source(observed)
    else:
        need_exportable(model, "c")
        watch = watched(model, ranges, "c")
        text = model_text(model, params, name, outputs, solver, derivatives, dtype, watch)
        parts = text.name, header(text), source(text)
    path = need_path(folder, "export.c")
    files = path / f"{parts[0]}.h", path / f"{parts[0]}.c"
    write_files(dict(zip(files, parts[1:], strict=True)), make_folders=True)
    return files


def model_text(
    system: System,
    params: Mapping[str, Any] | None,
    name: str | None,
    outputs: Sequence[str] | None,
    solver: str,
    derivatives: bool,
    dtype: Any,
    watch: Watch | None,
) -> ModelText:
    """What is written about a model; arguments as of `c`."""
    title = system.model._node.title or type(system.model).__name__
    chosen = _name(title, name)
    real = PRECISION[precision(dtype).name]
    wanted = tuple(system.states) if outputs is None else names_in(outputs, "export: outputs")
    need_known("export", params)
    given = all_parameters(system, params)
    vector = ParameterVector(system, given)
    scheme = scheme_named(solver)
    code = write_code(
        vector, wanted, derivatives=derivatives, column=scheme.is_implicit, watch=watch
    )
    numbers = len(system.layout.free)
    entries = vector.entries
    parameters = _with_units([e.name for e in entries[:numbers]], system)
    parameters += [(NameRange(e.name, e.first, e.size), "") for e in entries[numbers:]]
    start, start_d = _start(system, given)
    return ModelText(
        chosen, title, real, code, solver, scheme, vector,
        _states(system), _with_units(system.inputs, system),
        _with_units(wanted, system), parameters, start, limits_of(system, start),
        tuple(_discrete(system)), start_d,
    )  # fmt: skip


def _name(title: str, name: str | None) -> str:
    """What struct and functions are called, by default after a title.

    Raises:
        DataError: for what is no name in C.
    """
    chosen = _identifier(title) if name is None else name
    if not isinstance(chosen, str) or not re.fullmatch(r"[A-Za-z]\w*", chosen, re.ASCII):
        raise DataError(
            f"export.c: name={shown(name)} is no name in C; use letters, digits and underscores."
        )
    if name is None and chosen in RESERVED:
        return f"{chosen}_model"
    if chosen in RESERVED:
        raise DataError(
            f"export.c: name='{chosen}' is a word of C or of the model's file; give another."
        )
    return chosen


def _start(system: System, params: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """States, and discrete variables, before the first event."""
    x = np.asarray(system.initial_state(params), float)
    if system.events is None:
        return x, np.zeros(0)
    return x, np.asarray(system.blank(system.pack(params), 0.0).d, float)


def _discrete(system: System) -> Iterator[str]:
    """What the discrete variables are called; conditions by their components and texts."""
    events = system.events
    for place, node in enumerate(system.reduced.discrete.tolist()):
        is_condition = events is not None and place < events.n_guards
        yield events.describe(place) if events and is_condition else system.reduced.name(node)


def _states(system: System) -> list[tuple[NameRange, str]]:
    """The states; the angles of closed loops are guesses, beside the angles themselves, which are computed."""
    n = system.reduced.n_independent
    guesses = enumerate(system.states[n:], n)
    return _with_units(system.states[:n], system) + [
        (NameRange(f"guess({name})", i), system.unit(name)) for i, name in guesses
    ]


def _with_units(names: Sequence[str], system: System) -> list[tuple[NameRange, str]]:
    return [(run, system.unit(run.names[0])) for run in runs(names)]


def _identifier(title: str) -> str:
    """The last part of a class's name in small letters, words apart by underscores."""
    last = re.sub(r"\W+", "_", title.rpartition(".")[2], flags=re.ASCII).strip("_") or "model"
    name = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", last).lower().lstrip("_0123456789") or "model"
    return f"{name}_model" if name in RESERVED else name
