"""The result of predicting records: errors, bands, a plot and a page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from acausal.errors import known_name, need_text
from acausal.files import csv_text, need_path, write_files
from acausal.pages import schematic, write_page
from acausal.reporting import (
    Band,
    PageContent,
    PlainTable,
    Tab,
    Text,
    plot_predictions,
    table,
    titled_sections,
)
from acausal.training.presentation.page_of_several import prediction_blocks
from acausal.training.record_fit import RecordFit

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Prediction(RecordFit):
    """A record as a trained model predicts it, in one simulation.

    Attributes, besides those of `RecordFit`:
        bands: by target, the prediction over time with its standard deviation: that of the laws and parameters, of what
            was found for this record, and of the noise. With conformal bands the bounds are theirs.
        outside: a sentence on what leaves the training's range, where the model extrapolates; empty where nothing does.
        doubts: sentences on why it may not hold: a model so sensitive to its start that no single simulation follows
            such a record, targets that are missed by much more than their noise.
        found: a clause on the initial states that were found from the record's own targets; empty without any.
        units: of the targets.
    """

    bands: Mapping[str, Band]
    outside: str
    doubts: tuple[str, ...]
    found: str
    units: Mapping[str, str]

    @property
    def normalized(self) -> dict[str, float]:
        """By target, the root mean square error relative to the target's standard deviation in the training."""
        sizes = zip(self.rms.items(), self.sigma.tolist(), strict=True)
        return {n: error / size for (n, error), size in sizes}

    @property
    def inside(self) -> dict[str, float]:
        """By target, the share of its measurements that lie within the band; NaN without any."""

        def share(i: int, band: Band) -> float:
            low, high = band.bounds
            y = self.measured[:, i]
            known = np.isfinite(y)
            return float(np.mean((low <= y) & (y <= high), where=known)) if known.any() else np.nan

        return {n: share(i, band) for i, (n, band) in enumerate(self.bands.items())}

    def plot(self) -> Figure:
        """Every target over time: as measured, and as predicted with its band.

        Returns:
            The matplotlib figure.
        """
        return plot_predictions(self.time, self.measured, self.bands, self.units)

    def to_csv(self, path: str | Path) -> Path:
        """Write time and, of every target, the prediction and the bounds of its band as columns; returns the file.

        Raises:
            DataError: if the file cannot be written.
        """
        path, columns = need_path(path, "to_csv"), {"time [s]": self.time}
        for name, band in self.bands.items():
            sides = zip(("", " low", " high"), (band.law, *band.bounds), strict=True)
            columns |= {f"{name}{side} [{self.units[name]}]": y for side, y in sides}
        write_files({path: csv_text(columns)}, make_folders=True)
        return path

    def __repr__(self) -> str:
        known = {n: v for n, v in self.inside.items() if not np.isnan(v)}
        errors = ", ".join(f"{n} {self.rms[n]:.4g} {self.units[n]}".rstrip() for n in known)
        shares = ", ".join(f"{n} {100 * v:.0f} %" for n, v in known.items())
        lines = [
            f"Prediction of '{self.name}', {len(self.time)} samples",
            f"  RMS error: {errors}" if known else "  no target is measured",
        ]
        lines += [f"  within its band: {shares}"] if known else []
        lines += [f"  x0 found: {self.found}"] if self.found else []
        own = ", ".join(f"{n} {value:.5g}" for n, value in self.parameters.items())
        lines += [f"  its own: {own}"] if own else []
        return "\n".join([*lines, *(f"  {one}" for one in self.remarks)])

    @property
    def remarks(self) -> list[str]:
        """What is to be said of it, a sentence each."""
        return [*([self.outside] if self.outside else []), *self.doubts]


@dataclass(frozen=True, eq=False)
class Predictions(Mapping[str, Prediction]):
    """Predictions of records by name: ``found["monday"].plot()``.

    Attributes:
        records: the same as a dict.
        system: the model.
    """

    records: dict[str, Prediction]
    system: System

    def __getitem__(self, name: str) -> Prediction:
        return self.records[known_name(name, self.records, "There is no record")]

    def __iter__(self) -> Iterator[str]:
        return iter(self.records)

    def __len__(self) -> int:
        return len(self.records)

    @property
    def errors(self) -> DataFrame | PlainTable:
        """A row for each target of each record, ``"monday: mass.s"``: samples, errors, and the share within its band.

        A pandas DataFrame; without pandas a `PlainTable`, which prints the same. What is not measured has NaN.
        """
        return PlainTable(self._rows()).as_data_frame()

    def _rows(self) -> dict[str, dict[str, float | str]]:
        return {
            f"{found.name}: {name}": {
                "samples": int(np.isfinite(found.measured[:, i]).sum()),
                "RMS error": found.rms[name],
                "unit": unit,
                "normalized": found.normalized[name],
                "within band": found.inside[name],
            }
            for found in self.records.values()
            for i, (name, unit) in enumerate(found.units.items())
        }

    def report(self, path: str | Path, title: str = "Prediction") -> Path:
        """Write a page about the predictions, one HTML file; arguments and errors as those of `Fit.report`."""
        return write_page(self.page_content(title), need_path(path, "report"))

    def page_content(self, title: str = "") -> PageContent:
        """All that the page shows."""
        rows = self._rows()
        header = ["record and target", *next(iter(rows.values()))]
        cells = [
            [n, *(f"{v:.4g}" if isinstance(v, float) else v for v in row.values())]
            for n, row in rows.items()
        ]
        remarks = [one for p in self.records.values() for one in p.remarks]
        remarks += [f"'{n}': x0 found, {p.found}." for n, p in self.records.items() if p.found]
        units = next(iter(self.records.values())).units
        bands = {n: p.bands for n, p in self.records.items()}
        shown = prediction_blocks(self.records, bands, units, "predicted", "")
        sections = {
            "Errors": [table(header, cells), *map(Text, remarks)],
            "Measured and predicted": [*shown],
        }
        count = len(self)
        many = f"{count} records predicted, each in one simulation."
        lead = "1 record predicted in one simulation." if count == 1 else many
        return PageContent(
            need_text(title, "title") or "Prediction",
            lead,
            schematic(self.system.model),
            (),
            (Tab("Records", titled_sections(sections)),),
        )

    def __repr__(self) -> str:
        return "\n".join(map(repr, self.records.values()))
