"""Records made by chance from time bases, kinds of numbers, units, gaps and containers, some with a defect.

A sound one holds, in the model's units, what NumPy says; one with a defect is refused in a sentence.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac

pd = pytest.importorskip("pandas")
xr = pytest.importorskip("xarray")
scipy_io = pytest.importorskip("scipy.io")

EPOCH = np.datetime64("2024-02-28T23:59:58", "ns")
N_RECORDS = 1200

BASES: dict[str, Callable[[np.ndarray], Any]] = {
    "seconds": lambda ms: ms / 1e3,
    "seconds from a million on": lambda ms: 1e6 + ms / 1e3,
    "whole milliseconds": lambda ms: ms,
    "minutes": lambda ms: ms / 6e4,
    "single precision": lambda ms: (ms / 1e3).astype(np.float32),
    "a list": lambda ms: (ms / 1e3).tolist(),
    "an array of JAX": lambda ms: jnp.asarray(ms / 1e3),
    **{
        f"spans of {u}": lambda ms, u=u: ms.astype("timedelta64[ms]").astype(f"timedelta64[{u}]")
        for u in ("ns", "us", "ms")
    },
    **{
        f"dates of {u}": lambda ms, u=u: (EPOCH + ms.astype("timedelta64[ms]")).astype(
            f"datetime64[{u}]"
        )
        for u in ("ns", "us", "ms")
    },
    "dates of a zone": lambda ms: pd.DatetimeIndex(
        EPOCH + ms.astype("timedelta64[ms]"), tz="Europe/Berlin"
    ),
    "a series of spans": lambda ms: pd.Series(ms.astype("timedelta64[ms]")),
}
"""Times from whole milliseconds."""

TIME_UNIT = {"whole milliseconds": "ms", "minutes": "min"}

KINDS: dict[str, Callable[[np.ndarray], Any]] = {
    "numbers": lambda y: y,
    "single precision": lambda y: y.astype(np.float32),
    "whole numbers": lambda y: np.round(y).astype(int),
    "a list": lambda y: y.tolist(),
    "objects": lambda y: y.astype(object),
    "every second of more": lambda y: np.repeat(y, 2)[::2],
    "the other byte order": lambda y: y.astype(">f8"),
    "an array of JAX": lambda y: jnp.asarray(y),
    "a series": lambda y: pd.Series(y, index=np.arange(len(y)) + 7),
}

UNITS: dict[str, dict[str, tuple[float, float]]] = {
    "s": {"m": (1.0, 0.0), "mm": (1e-3, 0.0), "km": (1e3, 0.0)},
    "v": {"m/s": (1.0, 0.0), "km/h": (1 / 3.6, 0.0)},
    "T": {"K": (1.0, 0.0), "degC": (1.0, 273.15)},
}
"""By signal and unit what turns it into the model's: factor and offset."""

DEFECTS = (
    "a time twice", "a time that goes back", "no time", "not a number", "infinite", "text", "complex", "too short",
    "two dimensions", "an unknown unit", "a unit of another kind", "nothing",
)  # fmt: skip


@dataclass
class Made:
    """A record in the making: ``values`` are as given, ``truth`` in the model's units, with NaN for missing ones."""

    base: str
    kind: str
    container: str
    units: dict[str, str] | None
    defect: str | None
    gaps: str
    times: Any
    values: dict[str, Any]
    seconds: np.ndarray
    truth: dict[str, np.ndarray]
    mask: dict[str, np.ndarray] | None

    @property
    def is_refused(self) -> bool:
        """Whether a sentence is wanted: for a defect, and for what needs a decision of the user's."""
        dates = "date" in self.base and self.container in ("arrays", "pairs")
        objects = self.kind == "objects" and self.container not in PLAIN
        return self.defect is not None or dates or objects

    def __str__(self) -> str:
        what = f"{self.container}, times as {self.base}, values as {self.kind}, units {self.units}, gaps {self.gaps}"
        return what if self.defect is None else f"{what}, defect: {self.defect}"


def made(seed: int) -> Made:
    """The record of a seed."""
    chance, numbers = random.Random(seed), np.random.default_rng(seed)
    n = chance.randint(3, 40)
    ms = np.cumsum(numbers.integers(1, 400, n)) - 1
    base, kind = chance.choice([*BASES]), chance.choice([*KINDS])
    container = chance.choice([*CONTAINERS])
    if container in PLAIN:
        base, kind = chance.choice(["seconds", "seconds from a million on"]), "numbers"
    units = {k: chance.choice([*u]) for k, u in UNITS.items()} if chance.random() < 0.6 else None
    if units is not None and base in TIME_UNIT:
        units["time"] = TIME_UNIT[base]
    if units is None and base in TIME_UNIT:
        base = "seconds"
    defect = chance.choice(DEFECTS) if chance.random() < 0.4 else None
    if (container, defect) in IMPOSSIBLE or ("frame" in container and defect == "too short"):
        defect = None
    gaps = "none" if defect else chance.choice(["none", "none", "NaN", "mask"])
    if gaps == "mask" and container != "arrays":
        gaps = "NaN"
    if gaps == "NaN" and kind == "whole numbers":
        kind = "numbers"
    values: dict[str, Any] = {}
    truth: dict[str, np.ndarray] = {}
    missing: dict[str, np.ndarray] = {}
    for name, of in UNITS.items():
        y = 300 + 20 * numbers.normal(size=n)
        gone = numbers.random(n) < 0.3
        gone[numbers.integers(n)] = False
        missing[name] = gone
        if gaps == "NaN":
            y = np.where(gone, np.nan, y)
        values[name] = KINDS[kind](y)
        factor, offset = of[units[name]] if units else (1.0, 0.0)
        known = np.asarray(values[name], float)
        truth[name] = np.where(gone & (gaps != "none"), np.nan, factor * known + offset)
    seconds = ms / 1e3
    if base == "seconds from a million on":
        seconds = 1e6 + seconds
    if "date" in base:
        seconds = seconds - seconds[0]
    mask = {name: ~gone for name, gone in missing.items()} if gaps == "mask" else None
    one = Made(
        base, kind, container, units, defect, gaps, BASES[base](ms), values, seconds, truth, mask
    )
    if defect:
        spoil(one, ms, chance)
    return one


def spoil(one: Made, ms: np.ndarray, chance: random.Random) -> None:
    """Give a record its defect."""
    place, name = chance.randrange(1, len(ms)), chance.choice([*UNITS])
    y = np.array(one.values[name], float)
    if one.defect in ("a time twice", "a time that goes back"):
        ms = ms.copy()
        ms[place] = ms[place - 1] - (one.defect == "a time that goes back")
        one.times = BASES[one.base](ms)
    elif one.defect == "no time":
        if one.base == "dates of a zone":
            one.times = one.times.insert(place, pd.NaT).delete(place + 1)
            return
        times = np.array(one.times, copy=True)
        times = times if times.dtype.kind in "mM" else times.astype(float)
        times[place] = "NaT" if times.dtype.kind in "mM" else np.nan
        one.times = times
    elif one.defect in ("not a number", "infinite"):
        y[place] = np.nan if one.defect == "not a number" else np.inf
        one.values[name] = y
    elif one.defect == "text":
        one.values[name] = ["much" if i == place else str(v) for i, v in enumerate(y)]
    elif one.defect == "complex":
        one.values[name] = y + 1j
    elif one.defect == "too short":
        one.values[name] = y[:-1]
    elif one.defect == "two dimensions":
        one.values[name] = np.stack([y, y], axis=1)
    elif one.defect == "nothing":
        one.times, one.values = np.asarray(one.times)[:0], dict.fromkeys(UNITS, y[:0])
    else:
        one.units = {k: "m" if k == "s" else "m/s" if k == "v" else "K" for k in UNITS}
        one.units |= {"time": TIME_UNIT[one.base]} if one.base in TIME_UNIT else {}
        one.units[name] = "floob" if one.defect == "an unknown unit" else "V"


def of_arrays(one: Made, folder: Path) -> Any:
    missing = "nan" if one.gaps == "NaN" else "refuse"
    return ac.Data(one.times, one.values, one.units, missing=missing, mask=one.mask)


def of_pairs(one: Made, folder: Path) -> Any:
    """Each signal with times of its own; a missing sample is left out."""
    pairs = {}
    for name, y in one.values.items():
        there = ~np.isnan(one.truth[name]) if one.gaps == "NaN" else slice(None)
        pairs[name] = (np.asarray(one.times)[there], np.asarray(y)[there])
    return ac.Data(None, pairs, one.units)


def frame_of(one: Made) -> Any:
    y = {n: v.to_numpy() if isinstance(v, pd.Series) else v for n, v in one.values.items()}
    frame = pd.DataFrame(
        {"time": np.asarray(one.times) if isinstance(one.times, pd.Series) else one.times}
    )
    for name, column in y.items():
        frame[name] = list(column) if np.ndim(column) > 1 else column
    if one.units:
        frame.attrs["units"] = one.units
    return frame


def of_frame(one: Made, folder: Path) -> Any:
    return ac.Data.from_dataframe(frame_of(one), missing="nan" if one.gaps == "NaN" else "refuse")


def of_index(one: Made, folder: Path) -> Any:
    frame = frame_of(one)
    attributes, frame = dict(frame.attrs), frame.set_index("time")
    frame.attrs.update(attributes)
    return ac.Data.from_dataframe(frame, missing="nan" if one.gaps == "NaN" else "refuse")


def of_rows(one: Made, folder: Path) -> Any:
    """A frame of which rows were left out before."""
    frame = frame_of(one)
    doubled = pd.concat([frame, frame]).iloc[: len(frame)]
    doubled.attrs.update(frame.attrs)
    return ac.Data.from_dataframe(doubled, missing="nan" if one.gaps == "NaN" else "refuse")


def of_text(one: Made, folder: Path) -> Any:
    separator, decimal = random.Random(len(one.seconds)).choice(
        [(",", "."), (";", ","), ("\t", "."), (";", ".")]
    )
    frame = frame_of(one)
    if one.units:
        frame = frame.rename(
            columns={n: f"{n} [{u}]" for n, u in {"time": "s", **one.units}.items()}
        )
    frame.to_csv(folder / "a.csv", index=False, sep=separator, decimal=decimal)
    return ac.Data.from_csv(folder / "a.csv", missing="nan" if one.gaps == "NaN" else "refuse")


def of_matlab(one: Made, folder: Path) -> Any:
    columns = {n: np.asarray(v) for n, v in {"time": one.times, **one.values}.items()}
    scipy_io.savemat(folder / "a.mat", columns)
    missing = "nan" if one.gaps == "NaN" else "refuse"
    return ac.Data.from_mat(
        folder / "a.mat", units=one.units and {"time": "s", **one.units}, missing=missing
    )


def of_xarray(one: Made, folder: Path) -> Any:
    times = np.asarray(one.times, float) if one.base == "an array of JAX" else np.asarray(one.times)
    if one.base == "dates of a zone":
        times = one.times.tz_convert(None).to_numpy()
    variables = {n: ("time", np.asarray(v)) for n, v in one.values.items()}
    found = xr.Dataset(variables, coords={"time": times})
    for name, unit in (one.units or {}).items():
        found[name].attrs["units"] = unit
    return ac.Data.from_xarray(found, missing="nan" if one.gaps == "NaN" else "refuse")


IMPOSSIBLE = {
    *(("MATLAB", d) for d in ("text", "complex", "too short", "two dimensions")),
    *(("xarray", d) for d in ("too short", "two dimensions")),
    ("text", "too short"),
}
"""Containers that cannot have a defect, or that leave out what has it, as their documentation says."""

CONTAINERS: dict[str, Callable[[Made, Path], Any]] = {
    "arrays": of_arrays,
    "pairs": of_pairs,
    "a frame": of_frame,
    "a frame with an index": of_index,
    "rows of a frame": of_rows,
    "text": of_text,
    "MATLAB": of_matlab,
    "xarray": of_xarray,
}
PLAIN = ("text", "MATLAB")
"""Those that hold plain numbers."""


@cache
def system() -> ac.System:
    """A model with a length, a speed and a temperature."""

    class Three(ac.Component):
        s = ac.Variable(unit="m")
        v = ac.Variable(unit="m/s")
        T = ac.Variable(unit="K")

        def equations(self) -> Iterator[ac.Eq]:
            yield ac.Eq(ac.der(self.s), self.v)
            yield ac.Eq(self.v, 1.0 * self.s)
            yield ac.Eq(ac.der(self.T), 0.0)

    return ac.compile(Three())


def judged(one: Made, folder: Path) -> tuple[str, str]:
    """right, refused, silent or raw; and why."""
    try:
        found = CONTAINERS[one.container](one, folder).for_system(system())
    except ac.AcausalError as error:
        return "refused", str(error)
    except Exception as error:
        return "raw", f"{type(error).__name__}: {error}"
    if one.is_refused:
        return "silent", "nothing was said"
    return compared(found, one.seconds, one.truth, one)


def compared(
    found: ac.Data, seconds: np.ndarray, truth: Mapping[str, np.ndarray], one: Made
) -> tuple[str, str]:
    """Whether a record holds what it should."""
    near = 1e-5 if "single precision" in (one.base, one.kind) else 1e-9
    for name, y in truth.items():
        there = ~np.isnan(y)
        t, values = found.samples(name)
        if t.shape != seconds[there].shape:
            return "silent", f"{name} has {len(t)} samples, not {there.sum()}"
        if not np.allclose(t, seconds[there], rtol=near, atol=1e-6):
            return "silent", f"times {t[:3]} are {seconds[there][:3]}"
        if not np.allclose(values, y[there], rtol=near):
            return "silent", f"{name} = {values[:3]} is {y[there][:3]}"
    return "right", ""


@pytest.mark.slow
def test_records_hold_what_numpy_says(tmp_path: Path, record_property: Any) -> None:
    counts: Counter[str] = Counter()
    bad: list[str] = []
    for seed in range(N_RECORDS):
        one = made(seed)
        sort, why = judged(one, tmp_path)
        counts[sort] += 1
        if sort != ("refused" if one.is_refused else "right"):
            bad.append(f"seed {seed}: {sort}: {one}\n  {why}")
    lines = [f"{N_RECORDS} records", *(f"{n:>6} {sort}" for sort, n in sorted(counts.items()))]
    record_property("mutants", ("and right records", lines))
    assert not bad, "\n".join([str(dict(counts)), *bad])
