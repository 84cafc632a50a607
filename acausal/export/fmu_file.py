"""`fmu`: a model as a functional mock-up unit, for other tools."""

from __future__ import annotations

import hashlib
import math
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from importlib.resources import files as package_files
from io import BytesIO
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from acausal._jax import compiled
from acausal.codegen import Values
from acausal.errors import (
    DataError,
    ExportError,
    known_name,
    listing,
    need_flag,
    shown,
    warn,
)
from acausal.events import Events, updated
from acausal.export.c_file import model_text
from acausal.export.c_text.header import header as header_in_c
from acausal.export.c_text.source import source
from acausal.export.c_text.text import ModelText
from acausal.export.fmu_text.binary import (
    PLATFORMS,
    Platform,
    build,
    compiler,
    cross_compiler,
    platform_named,
    this_platform,
)
from acausal.export.fmu_text.dependencies import dependencies
from acausal.export.fmu_text.description import (
    KINDS,
    ModelDescription,
    build_description,
    documentation,
)
from acausal.export.fmu_text.header import model_header
from acausal.export.fmu_text.variables import event_indicators, shown_by_others, variables
from acausal.export.needs import need_exportable
from acausal.export.ranges import Ranges, Watch, watched
from acausal.files import file_to_write, write_files
from acausal.modeling import elements_of, names_in
from acausal.simulation import STABILITY_LIMIT, fastest_mode
from acausal.system import System

VERSIONS = ("2.0", "3.0")
STEP = 1e-3
"""The longest default step of co-simulation [s]."""
SHORTEST = 1e-6
"""The shortest [s]; for a model that needs shorter ones an implicit solver is better."""
MOST_POSITIONS = 50
"""Of so many conditions the opposite is looked at."""


def fmu(
    system: System,
    path: str | Path,
    params: Mapping[str, Any] | None = None,
    *,
    fmi: str = "3.0",
    kinds: str | Sequence[str] = ("model_exchange", "co_simulation"),
    inputs: Sequence[str] | None = None,
    outputs: Sequence[str] | None = None,
    solver: str = "rk4",
    step: float | None = None,
    name: str | None = None,
    ranges: Ranges | None = None,
    binary: bool = True,
    platforms: Sequence[str] | None = None,
) -> Path:
    """Write a model as an FMU: C sources, a library for this platform, and a description of its variables.

    Parameters are tunable, those of networks among them. Directional derivatives and copies of the state are there.
    In FMI 3, component lists and arrays of networks are arrays; in FMI 2 every number is a variable.

    Arguments:
        system: a compiled model.
        path: of the file, as a rule with the ending ``.fmu``.
        params: as `System.parameters` gives them, for example ``fit.params``; by default the model's.
        fmi: the version of the standard, ``"3.0"`` or ``"2.0"``.
        kinds: ``"model_exchange"``, ``"co_simulation"``, or both.
        inputs: those that the importer sets, by default all; the others become parameters that start at 0.
        outputs: names of variables, by default the states.
        solver: of co-simulation, a fixed-step one as in `acausal.export.c`.
        step: of co-simulation, at most [s]; a communication step is divided into equal steps, inputs held. By default
            1e-3, or less where an explicit solver needs that for the model's fastest mode at the start, or where one
            of its conditions is the opposite of what it is there.
        name: of files in the FMU; by default the model's class in small letters.
        ranges: by network the interval of its argument in training, or one for each argument, such as ``fit.ranges``:
            the Boolean output ``outside_training_range`` tells whether an argument has left its range.
        binary: whether libraries are built; without a compiler only the sources are written.
        platforms: those that libraries are built for, such as ``["x86_64-linux", "x86_64-windows", "aarch64-darwin"]``,
            by default this computer's; others need ``pip install 'acausal[export-platforms]'``.

    Returns:
        The path.

    Raises:
        DataError: for an unknown name, what is no path of a file, or an argument that does not fit.
        ExportError: for an operation without C, a solver that has no fixed steps in C, or a platform without a
            compiler.
    """
    need_exportable(system, "fmu")
    target = file_to_write(path, "export.fmu")
    chosen = _checked_kinds(fmi, kinds, STEP if step is None else step)
    places = _checked_platforms(platforms, fmi) if need_flag(binary, "binary") else ()
    scalars = fmi == "2.0"
    free = _known(inputs, system.inputs)
    wanted = _wanted(outputs, system)
    merged = set(shown_by_others(system, wanted, scalars))
    own = [n for n in wanted if n not in merged]
    watch = watched(system, ranges, "fmu")
    text = model_text(system, params, name, own, solver, True, np.float64, watch)
    if text.name.startswith(("fmu_", "fmi2_", "fmi3_")):
        raise DataError(f"export.fmu: name='{text.name}' is kept for FMI's files; give another.")
    length = STEP if step is None else float(step)
    if "co_simulation" in chosen and not text.scheme.is_implicit:
        length = _stable(system, text, params, length, step is None)
    content = _content(text, system, watch, free, wanted, fmi, chosen, length, places)
    write_files({target: _zipped(content)})
    return target


def _content(
    text: ModelText,
    system: System,
    watch: Watch | None,
    inputs: Sequence[str],
    outputs: Sequence[str],
    fmi: str,
    kinds: Sequence[str],
    step: float,
    platforms: Sequence[Platform] | None,
) -> dict[str, bytes]:
    """The FMU's files by their paths in it."""
    scalars, interface = fmi == "2.0", f"fmi{fmi[0]}"
    templates = package_files("acausal.export.fmu_text")
    fixed = (
        "fmu_instance.h",
        "fmu_functions.h",
        f"{interface}_interface.h",
        f"{interface}_functions.c",
    )
    sources = {f"{text.name}.h": header_in_c(text), f"{text.name}.c": source(text)}
    sources |= {file: templates.joinpath(file).read_text("utf-8") for file in fixed}
    compiled = (f"{text.name}.c", f"{interface}_functions.c")
    found = variables(text, system, inputs, outputs, scalars)
    read = dependencies(text, system, found, np.zeros(0) if watch is None else watch.nodes)
    indicators = len(event_indicators(text))
    without_token = ModelDescription(
        fmi, text.name, text.title, "", kinds, step, found, read, compiled, indicators, _experiment(system)
    )  # fmt: skip
    nominal = np.abs(system.reduced.nominal(system.reduced.states))
    header = partial(model_header, text, step=step, kinds=kinds, scalars=scalars, nominal=nominal)
    digest = hashlib.sha256(without_token.xml())
    for part in (header(token=""), *sources.values()):
        digest.update(part.encode())
    description = replace(without_token, token=f"{{{digest.hexdigest()[:32]}}}")
    sources["fmu_model.h"] = header(token=description.token)
    about = (type(system.model).__doc__ or "").strip().partition("\n")[0]
    content = {
        "modelDescription.xml": description.xml(),
        "documentation/index.html": documentation(description, about),
    }
    content |= {f"sources/{file}": data.encode() for file, data in sources.items()}
    if fmi == "3.0":
        content["sources/buildDescription.xml"] = build_description(text.name, compiled)
    for place, command in _compilers(platforms, fmi):
        library = build(text.name, sources, compiled, command)
        content[f"binaries/{place.folder}/{text.name}{place.ending}"] = library
    return content


def _stable(
    system: System, text: ModelText, params: Mapping[str, Any] | None, step: float, is_default: bool
) -> float:
    """The step, or by default a shorter one, at which an explicit solver is stable at the start.

    There conditions are what they are, and each of them in turn the opposite: a diode that blocks will conduct.
    """
    x, u = jnp.asarray(text.start), jnp.zeros(len(system.inputs))
    at = Values(jnp.zeros(()), x, u, system.pack(params), jnp.asarray(text.discrete_start))
    at = system.in_modes(at)
    rows = at._replace(t=jnp.zeros(1), x=x[None], u=u[None])
    modes = [fastest_mode(system, rows._replace(d=d))[0] for d in _switch_positions(system, at)]
    damping = max(modes)
    if damping * step <= STABILITY_LIMIT:
        return step
    needed = 10 ** np.floor(np.log10(1 / damping))
    if is_default and needed >= SHORTEST:
        return float(needed)
    where = "at the start"
    if damping > modes[0]:
        where = "where a condition is not what it is at the start"
    warn(
        f"export.fmu: steps of {step:g} s are too long for '{text.solver}' and the model's fastest mode, "
        f"{damping:.3g} 1/s {where}; give step={needed:.1g}, or an implicit solver such as solver='kvaerno3'."
    )
    return step


def _switch_positions(system: System, at: Values) -> Iterator[Any]:
    """Discrete variables at the start, and with one condition after the other, or all, the opposite."""
    events = system.events
    if events is None or at.d is None:
        yield None
        return
    n = events.n_guards
    yield at.d
    flipped = jnp.abs(jnp.concatenate([jnp.eye(n)[:MOST_POSITIONS], jnp.ones((1, n))]) - at.d[:n])
    yield from _discrete_variables(events, at, flipped)


@compiled
def _discrete_variables(events: Events, at: Values, conditions: jax.Array) -> jax.Array:
    """Those that follow from some conditions, a row for each of these."""
    return jax.vmap(lambda row: updated(events, at, at, row))(conditions)


def _experiment(system: System) -> tuple[float, ...]:
    """Start and, if it is known, stop of a simulation, from the file of a model."""
    known = getattr(system.model, "document", {})
    start, stop = known.get("start_time", 0.0), known.get("stop_time")
    return (float(start),) if stop is None else (float(start), float(stop))


def _compilers(
    platforms: Sequence[Platform] | None, fmi: str
) -> list[tuple[Platform, Sequence[str]]]:
    """Platforms and their compilers; by default this computer's, or none, with a warning, where it has none."""
    if platforms is not None:
        return [(place, _command(place, fmi)) for place in platforms]
    place, command = this_platform(fmi), compiler()
    if place is not None and command is not None:
        return [(place, [command])]
    missing = "there is no C compiler" if command is None else "FMI has no name for this platform"
    warn(f"export.fmu: {missing}, so the FMU holds sources only; its importer must compile them.")
    return []


def _command(place: Platform, fmi: str) -> Sequence[str]:
    """The compiler for a platform."""
    own = compiler() if place == this_platform(fmi) else None
    command = [own] if own else cross_compiler(place)
    if command is None:
        raise ExportError(
            f"export.fmu: a library for '{place.name}' needs the package ziglang; pip install "
            "'acausal[export-platforms]', or leave it out of platforms=[...]."
        )
    return command


def _zipped(content: Mapping[str, bytes]) -> bytes:
    """An archive that depends on nothing but its content."""
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, data in content.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, data)
    return stream.getvalue()


# -- arguments -----------------------------------------------------------------------------------------


def _checked_kinds(fmi: object, kinds: str | Sequence[str], step: float) -> tuple[str, ...]:
    if not (isinstance(fmi, str) and fmi in VERSIONS):
        raise DataError(f"export.fmu: there is no fmi={shown(fmi)}; give '3.0' or '2.0'.")
    chosen = names_in(kinds, "export.fmu: kinds")
    for kind in chosen:
        known_name(kind, KINDS, "export.fmu: there is no kind")
    if not chosen:
        raise DataError(f"export.fmu: kinds=() leaves nothing to write; give {listing(KINDS)}.")
    if not isinstance(step, int | float) or not (0 < step < math.inf):
        raise DataError(f"export.fmu: step={shown(step)} is no length of a step; give seconds.")
    return chosen


def _checked_platforms(names: Sequence[str] | None, fmi: str) -> tuple[Platform, ...] | None:
    """Platforms by name; None for this computer's."""
    if names is None:
        return None
    found: dict[str, Platform] = {}
    for name in dict.fromkeys(names_in(names, "export.fmu: platforms")):
        known_name(name, PLATFORMS, "export.fmu: there is no platform")
        place = platform_named(name, fmi)
        if place is None:
            raise DataError(
                f"export.fmu: FMI {fmi} has no name for '{name}'; leave it out, or write fmi='3.0'."
            )
        other = found.setdefault(place.folder, place)
        if other is not place:
            raise DataError(
                f"export.fmu: FMI {fmi} has one folder for '{other.name}' and '{name}'; give one of them, or fmi='3.0'."
            )
    return tuple(found.values())


def _known(inputs: Sequence[str] | None, known: Sequence[str]) -> tuple[str, ...]:
    if inputs is None:
        return tuple(known)
    chosen = names_in(inputs, "export.fmu: inputs")
    for name in chosen:
        known_name(name, known, "export.fmu: the model has no input")
    return chosen


def _wanted(outputs: Sequence[str] | None, system: System) -> tuple[str, ...]:
    if outputs is None:
        return tuple(system.states)
    known = system.variables
    named = [
        [n] if n in known or (array := elements_of(n, known)) is None else array.ravel().tolist()
        for n in names_in(outputs, "export.fmu: outputs")
    ]
    chosen = tuple(dict.fromkeys(n for names in named for n in names))
    for name in chosen:
        if name in system.inputs:
            raise DataError(f"export.fmu: '{name}' is an input; leave it out of outputs=[...].")
        if not name.startswith("der("):
            known_name(name, system.variables, "export.fmu: the model has no variable")
    return chosen
