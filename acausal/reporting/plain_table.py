"""A table of named rows, for what a model consists of, where pandas is not installed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from acausal.errors import known_name

if TYPE_CHECKING:
    from pandas import DataFrame

Row = Mapping[str, Any]


@dataclass(frozen=True, repr=False)
class PlainTable:
    """Rows by name: ``table["r.R"]["value"]``. It prints as text, and as HTML in notebooks.

    Attributes:
        rows: by name, the cells by column; all rows have the same columns.
    """

    rows: Mapping[str, Row]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(next(iter(self.rows.values()), {}))

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Row:
        """The row of that name.

        Raises:
            DataError: if there is none.
        """
        return self.rows[known_name(name, self.rows, "The table has no row")]

    def as_data_frame(self) -> DataFrame | PlainTable:
        """The same as a pandas DataFrame; where pandas is not installed, the table itself."""
        try:
            import pandas as pd
        except ImportError:
            return self
        # cells of one column may be numbers and texts
        frame = pd.DataFrame(list(self.rows.values()), index=list(self.rows), columns=self.columns)
        return frame.rename_axis("name").astype(object)

    def __repr__(self) -> str:
        cells = [
            ["", *self.columns],
            *([name, *self._texts(row)] for name, row in self.rows.items()),
        ]
        return aligned(cells)

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(column)}</th>" for column in ("", *self.columns))
        body = "".join(
            f"<tr><th>{escape(name)}</th>{''.join(f'<td>{escape(t)}</td>' for t in self._texts(row))}</tr>"
            for name, row in self.rows.items()
        )
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    def _texts(self, row: Row) -> Sequence[str]:
        return [cell_text(row[column]) for column in self.columns]


def aligned(rows: Sequence[Sequence[str]], *, right: bool = False) -> str:
    """Rows as text with columns below each other, to the left or to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    side = str.rjust if right else str.ljust
    return "\n".join("  ".join(map(side, row, widths)).rstrip() for row in rows)


def cell_text(value: Any) -> str:
    """A cell as text: numbers with six digits, nothing for nothing."""
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
