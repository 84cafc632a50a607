"""Measured data: one record of named signals, as a table over all times at which something was measured."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal._jax import check_time
from acausal.data.by_signal import (
    Choices,
    check_choices,
    check_unit_names,
    check_units,
    chosen,
    kept,
)
from acausal.data.formats import Formats
from acausal.data.given_columns import Missing, check_table, columns_of
from acausal.data.readers import SignalTable, is_data_frame, units_said
from acausal.data.samples import is_uniform
from acausal.data.signal import Beyond, Interpolation, Signal
from acausal.errors import DataError, known_name, listing, nearest, shown, warn
from acausal.modeling import ByName, names_in
from acausal.units import convert

if TYPE_CHECKING:
    from pandas import DataFrame

    from acausal.system import System

LONG = 10
"""An interval without samples is a gap if it is longer than this many median sample times of its signal."""

WARM, CELSIUS = 200.0, (-100.0, 150.0)
"""A temperature that is usually higher [K] is absolute, and no difference; values between these may be in degC."""

SIZE, MOST_PLOTS = (420, 96), 12
"""Of a plot in a row of a view, in pixels; and signals with a plot: further ones are in the table only."""


@dataclass(frozen=True, eq=False)
class Data(ByName, Formats):
    """A record of measured signals. ``data["mass.s"]`` is one, ``data[["mass.s", "mass.v"]]`` are two side by side.

    A record is a table over the sorted union of all sample times, in which a missing sample is NaN.

    Arguments:
        time: sample times, shape (n,), strictly increasing; in seconds unless ``units["time"]`` says
            otherwise. None if every signal has times of its own.
        signals: by name, samples of shape (n,), or a pair (times, samples) of a signal with times of its own; or a
            pandas DataFrame with a column for each. Times of two signals that differ by less than 1e-6 of the local
            sample time are one.
        units: unit of every signal by name, or of none; by default those of a DataFrame's ``attrs["units"]`` or of
            the signals' own, as xarray has them, else the model's units are assumed. That of ``"time"`` holds for all
            times.
        interpolation: of inputs between samples, one choice for all or by name, as of an
            `acausal.Signal`: ``"linear"``, ``"previous"``, ``"cubic"`` or ``"band-limited"``. Where nothing is
            chosen it is linear, and cubic for an input that the model differentiates.
        before_start, after_end: of inputs beyond the samples, one choice for all or by name, as of an
            `acausal.Signal`: ``"refuse"`` (the default) a simulation that reaches beyond the samples, ``"hold"`` the
            end values, continue them in a ``"linear"`` way, or repeat the record as a ``"periodic"`` one.
        missing: what a NaN among the samples is: ``"refuse"`` it as a mistake, or ``"nan"``, a missing sample.
        mask: by name, an array of truth values for the signal's samples: those with False are missing.

    Attributes:
        missing: ``"nan"`` if samples may be missing: because that was said, by a mask, or because signals have
            different times.

    Raises:
        DataError: for a time base that does not increase, samples that are not finite real numbers and not missing,
            a signal without any sample, a signal without a unit where others have one, an unknown choice.
    """

    time: Float[np.ndarray, " n"]
    signals: Mapping[str, Float[np.ndarray, " n"]]
    units: Mapping[str, str] | None = None
    interpolation: Choices = None
    before_start: Choices = None
    after_end: Choices = None
    missing: Missing = "refuse"

    def __init__(
        self,
        time: ArrayLike | None = None,
        signals: Mapping[str, Any] | DataFrame | None = None,
        units: Mapping[str, str] | None = None,
        interpolation: Choices = None,
        *,
        before_start: Choices = None,
        after_end: Choices = None,
        missing: Missing = "refuse",
        mask: Mapping[str, ArrayLike] | None = None,
    ) -> None:
        said = units_said(signals) if units is None else units
        units = None if said is None else check_units(said)
        unit_of_time = (units or {}).get("time", "s")
        ts, columns, missing = columns_of(time, signals, missing, mask, unit_of_time)
        ts = convert(ts, unit_of_time, "s", "'time'")
        units = {n: u for n, u in (units or {}).items() if n != "time"} or None
        if units is not None:
            check_unit_names(units, columns)
        check_choices("interpolation", interpolation, get_args(Interpolation), columns)
        check_choices("before_start", before_start, get_args(Beyond), columns)
        check_choices("after_end", after_end, get_args(Beyond), columns)
        for field, value in (
            ("time", ts),
            ("signals", columns),
            ("units", units),
            ("interpolation", interpolation),
            ("before_start", before_start),
            ("after_end", after_end),
            ("missing", missing),
        ):
            object.__setattr__(self, field, value)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the signals."""
        return tuple(self.signals)

    @classmethod
    def of(cls, record: Data | Mapping[str, Any] | DataFrame) -> Data:
        """A record as it is; or made from a plain mapping ``{"time": ..., name: ...}``, or from a pandas DataFrame.

        A data frame has the times in a column ``time``, or as its index.
        """
        if isinstance(record, Data):
            return record
        if is_data_frame(record):
            return cls.from_dataframe(record)
        if not isinstance(record, Mapping):
            raise DataError(f"A record is acausal.Data or a mapping, not {shown(record)}")
        known_name("time", record, "The record has no")
        return cls(record["time"], {n: v for n, v in record.items() if n != "time"})

    @classmethod
    def _of_table(cls, table: SignalTable, options: Mapping[str, Any]) -> Data:
        missing = options.get("missing", "refuse")
        try:
            check_table(table, missing)
            return cls(table.time, table.signals, table.units or None, **options)
        except DataError as e:
            raise DataError(f"{table.source}: {e}" if table.source else str(e)) from None

    def for_system(self, system: System) -> Data:
        """The record in the model's units.

        Raises:
            DataError: for a name that is not a variable of the model, or a unit of another dimension.

        Warns:
            UserWarning: of temperatures without a unit that look like degrees Celsius where the model has kelvins.
        """
        if not hasattr(system, "vector_field"):
            raise DataError(
                f"for_system needs a compiled model, got {shown(system)}: give ac.compile(model)."
            )
        known = (*system.variables, *system.inputs)
        unknown = [n for n in self.signals if n not in known]
        if unknown:
            raise DataError(
                f"The data have {listing(unknown)}, but the model does not: "
                f"{nearest(unknown[0], known)} Leave others out by data.select([...])."
            )
        if self.units is None:
            _warn_of_celsius(self.signals, system)
            return self
        given = self.units
        converted = {
            n: convert(v, given[n], system.unit(n), f"'{n}'") for n, v in self.signals.items()
        }
        return self._with(self.time, converted, {n: system.unit(n) for n in converted})

    def columns(self, names: Iterable[str], purpose: str) -> Float[np.ndarray, "n n_names"]:
        """The named signals side by side; ``purpose`` is what they are needed for, in an error.

        Raises:
            DataError: if the record lacks signals; it lists them.
        """
        names = names_in(names)
        missing = [n for n in names if n not in self.signals]
        if missing:
            raise DataError(f"The data lack {listing(missing)}, {purpose}.")
        return self._side_by_side(names)

    @property
    def counts(self) -> dict[str, int]:
        """How many samples of each signal exist."""
        if self.missing == "refuse":
            return dict.fromkeys(self.signals, len(self))
        return {n: len(self) - int(np.count_nonzero(np.isnan(v))) for n, v in self.signals.items()}

    def samples(self, name: str) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
        """The times and the values of the samples of a signal that exist."""
        values = self._column(name)
        exist = ~np.isnan(values)
        return (self.time, values) if exist.all() else (self.time[exist], values[exist])

    def signal(self, name: str, interpolation: Interpolation = "linear") -> Signal:
        """A signal as a function of time, through the samples that exist; a long gap among them gives a warning.

        The interpolation is for a signal for which the record has no choice.
        """
        ts, values = self.samples(name)
        kind: Interpolation = chosen(self.interpolation, name, interpolation)
        if len(ts) < len(self):
            _warn_of_gaps(ts, name, kind)
        return Signal(
            ts,
            values,
            kind,
            before_start=chosen(self.before_start, name, "refuse"),
            after_end=chosen(self.after_end, name, "refuse"),
            name=name,
        )

    def between(self, start: float, end: float) -> Data:
        """The samples with ``start <= time <= end``.

        Raises:
            DataError: if there are fewer than two, if a signal has none, or for what is not a time.
        """
        check_time(start, "start")
        check_time(end, "end")
        inside = (self.time >= start) & (self.time <= end)
        if inside.sum() < 2:
            raise DataError(
                f"No two samples lie between {start:g} and {end:g} s; the record goes from "
                f"{self.time[0]:g} to {self.time[-1]:g} s."
            )
        part = {n: v[inside] for n, v in self.signals.items()}
        if self.missing == "nan":
            without = [n for n, v in part.items() if np.isnan(v).all()]
            if without:
                raise DataError(
                    f"Between {start:g} and {end:g} s the record has no samples of {listing(without)}; "
                    "leave them out by data.select([...])."
                )
        return self._with(self.time[inside], part)

    def select(self, names: Iterable[str]) -> Data:
        """The record with only the named signals."""
        return self._with(self.time, {n: self[n] for n in names_in(names)})

    def _with(
        self,
        time: np.ndarray,
        signals: Mapping[str, np.ndarray],
        units: Mapping[str, str] | None = None,
    ) -> Data:
        """A record like this one with other samples; its signals keep what was chosen for them, but for given units."""
        units = self.units if units is None else units
        return Data(
            time,
            signals,
            None if units is None else {n: units[n] for n in signals},
            kept(self.interpolation, signals),
            before_start=kept(self.before_start, signals),
            after_end=kept(self.after_end, signals),
            missing=self.missing,
        )

    @property
    def uniform(self) -> bool:
        """Whether the samples are equally spaced in time."""
        return is_uniform(self.time)

    @property
    def sample_time(self) -> float:
        """Mean time between samples, in seconds."""
        return float(self.time[-1] - self.time[0]) / (len(self.time) - 1)

    def _column(self, name: str) -> Float[np.ndarray, " n"]:
        return self.signals[known_name(name, self.signals, "The record has no")]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[np.ndarray, "n n_names"]:
        columns = [self._column(n) for n in names]
        return np.stack(columns, axis=1) if columns else np.zeros((len(self), 0))

    def __len__(self) -> int:
        return len(self.time)

    def _repr_html_(self) -> str:
        from acausal.reporting import Curve, Html, View, small_plot

        spacing = f"every {self.sample_time:g} s" if self.uniform else "at uneven times"
        about = f"{len(self)} samples {spacing}, from {self.time[0]:g} to {self.time[-1]:g} s"
        view = View(f"Data: {len(self.signals)} signal{'s' * (len(self.signals) != 1)}", about)
        counts, units = self.counts, self.units or {}
        some_lack = any(count < len(self) for count in counts.values())

        def plot(values: Float[np.ndarray, " n"]) -> str:
            exist = ~np.isnan(values)
            return small_plot([Curve("", self.time[exist], values[exist])], size=SIZE)

        rows = [
            (
                name,
                units.get(name, ""),
                *([f"{counts[name]} of {len(self)}"] if some_lack else []),
                np.nanmin(values),
                np.nanmax(values),
                Html(plot(values) if i < MOST_PLOTS else ""),
            )
            for i, (name, values) in enumerate(self.signals.items())
        ]
        count = ["samples"] if some_lack else []
        view.table(("", "unit", *count, "least", "largest", "over time in s"), rows)
        return str(view)

    def __repr__(self) -> str:
        spacing = f"{self.sample_time:g} s" if self.uniform else "an uneven time base"
        shares = {n: 1 - count / len(self) for n, count in self.counts.items()}
        absent = [f"{100 * share:.3g} % of '{n}'" for n, share in shares.items() if share]
        more = f"; missing: {', '.join(absent[:12])}" if absent else ""
        more += f" and of {len(absent) - 12} more" if len(absent) > 12 else ""
        return (
            f"Data({len(self)} samples at {spacing}, {self.time[0]:g} to {self.time[-1]:g} s: "
            f"{listing(self.signals)}{more})"
        )


def _warn_of_celsius(signals: Mapping[str, Float[np.ndarray, " n"]], system: System) -> None:
    """Warn of values such as 20 for temperatures that are about 300 in the model."""
    flat, representative = system.flat, system.reduced.aliases.representative
    for name, values in signals.items():
        variable = flat.layout.find_variable(name)
        if variable is None or system.unit(name) != "K":
            continue
        same = np.flatnonzero(representative[: flat.n_variables] == representative[variable])
        usual = float(np.nanmax(np.abs([flat.nominal[same], flat.start[same]])))
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        if usual >= WARM and CELSIUS[0] < low and high < CELSIUS[1]:
            warn(
                f"'{name}' lies between {low:.3g} and {high:.3g}, and the model has it in K. If these are degrees "
                f"Celsius, say so, ac.Data(..., units={{'{name}': 'degC', ...}}); if they are kelvins, 'K'."
            )


def _warn_of_gaps(ts: Float[np.ndarray, " n"], name: str, interpolation: str) -> None:
    """Warn once of the gaps of a signal that is used as a function of time, which it bridges; the longest is named."""
    steps = np.diff(ts)
    median = float(np.median(steps)) if len(steps) else 0.0
    count = int(np.count_nonzero(steps > LONG * median))
    if not count:
        return
    i = int(np.argmax(steps))
    others = f" and {count - 1} more gap{'s' * (count > 2)}" if count > 1 else ""
    warn(
        f"'{name}' has no samples from {ts[i]:g} to {ts[i + 1]:g} s, {steps[i] / median:.3g} times its median sample "
        f"time{others}; the interpolation '{interpolation}' bridges it. If that is wrong, use the record on both "
        "sides of the gap: data.between(start, end)."
    )
