"""What a page tells: texts, tables, equations, plots, and a card for every component. Nothing here knows HTML."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
from jaxtyping import Float, Int

from acausal.errors import need_text

Role = Literal["measured", "before", "after", "known", "sum", "other"]
"""What a curve is, which decides on its colour; ``other`` ones take colours in turn."""

Numbers = Float[np.ndarray, " n"]


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: str


@dataclass(frozen=True)
class Table:
    """A table of texts; of some rows, whether a target is hit (True) or missed (False)."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    passed: tuple[bool | None, ...] = ()


@dataclass(frozen=True)
class EquationList:
    """Equations, one below another.

    Attributes:
        equations: pairs of sympy expressions that are equal, or texts.
        names: None: names say whose they are. Else they are as short as they can be, some of them as given here.
    """

    equations: tuple[tuple[Any, Any] | str, ...]
    names: Mapping[str, str] | None = None


@dataclass(frozen=True)
class Drawing:
    """A drawing: SVG text, or the bytes of a PNG."""

    drawn: str | bytes
    caption: str


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of a plot.

    Attributes:
        label: what it is.
        x, y: its points; NaN breaks the curve.
        role: decides on its colour.
        sigma: standard deviation of ``y``: a band of two of them is drawn to either side, or
        bounds: of the band.
        dots: whether points are marked.
        steps: whether each value holds until the next.
    """

    label: str
    x: Numbers
    y: Numbers
    role: Role = "other"
    sigma: Numbers | None = None
    dots: bool = False
    steps: bool = False
    bounds: tuple[Numbers, Numbers] | None = None

    @property
    def band(self) -> tuple[Numbers, Numbers] | None:
        """The lower and the upper end of its band, if it has one."""
        if self.bounds is not None or self.sigma is None:
            return self.bounds
        return self.y - 2 * self.sigma, self.y + 2 * self.sigma

    def at(self, rows: Int[np.ndarray, " m"]) -> Curve:
        """The same at some of its points."""
        bounds = self.bounds and (self.bounds[0][rows], self.bounds[1][rows])
        sigma = None if self.sigma is None else self.sigma[rows]
        return replace(self, x=self.x[rows], y=self.y[rows], sigma=sigma, bounds=bounds)


@dataclass(frozen=True, eq=False)
class Plot:
    """Curves over one axis.

    Attributes:
        caption: what it shows, where the axes do not tell.
        xlabel, ylabel: names of the axes with units.
        curves: what is drawn.
        group: plots of one group are zoomed and read together; an empty text for none.
        guides: vertical lines.
        trusted: outside of this range of the horizontal axis the plot is shaded.
        samples: places that are marked on the horizontal axis.
        limits: what the vertical axis shows; by default what the curves need.
        log: whether the vertical axis is logarithmic.
        low: whether it is a low plot, as for errors below a trajectory.
    """

    caption: str
    xlabel: str
    ylabel: str
    curves: tuple[Curve, ...]
    group: str = ""
    guides: tuple[float, ...] = ()
    trusted: tuple[float, float] | None = None
    samples: Numbers = field(default_factory=lambda: np.zeros(0))
    limits: tuple[float, float] | None = None
    log: bool = False
    low: bool = False


@dataclass(frozen=True, eq=False)
class Moving:
    """An outline that moves.

    Attributes:
        name: whose it is.
        path: SVG path data in units of its own.
        x, y, phi: where its origin is [m] and how it is turned [rad], over time; one element for what does not change.
        along, across: its units along its own axes [m]; None for those of a mark.
        extent: least x and y of the path, and greatest ones, in its units.
        filled: whether it is an area.
        traced: whether the way of its origin can be shown.
    """

    name: str
    path: str
    x: Numbers
    y: Numbers
    phi: Numbers
    along: Numbers | None = None
    across: Numbers | None = None
    extent: tuple[float, float, float, float] = (-1.0, -1.0, 1.0, 1.0)
    filled: bool = False
    traced: bool = False


@dataclass(frozen=True, eq=False)
class Animation:
    """A mechanism that moves.

    Attributes:
        caption: what it shows.
        time: when [s].
        shapes: what moves, the ones behind first.
        trace: name of the one whose way is shown at first; an empty text for none.
    """

    caption: str
    time: Numbers
    shapes: tuple[Moving, ...]
    trace: str = ""


Block = Text | Table | EquationList | Plot | Drawing | Animation


@dataclass(frozen=True)
class Section:
    """A heading, unless it is empty, and what stands below it."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Card:
    """All about one component.

    Attributes:
        path: its dotted name; empty for the model itself.
        kind: its class.
        doc: a sentence on the class.
        learns: whether a network is in it.
        sections: what is known of it.
        schematic: drawing of its own parts, as that of the page.
    """

    path: str
    kind: str
    doc: str
    learns: bool
    sections: tuple[Section, ...]
    schematic: str = ""


@dataclass(frozen=True)
class Tab:
    """A part of the page that is shown at a time."""

    title: str
    sections: tuple[Section, ...]


@dataclass(frozen=True)
class PageContent:
    """All that a page shows.

    Attributes:
        title, lead: headline, and a sentence or two below it.
        schematic: drawing of the model as SVG, in which the groups of components carry ``data-component="path"``; an
            empty text for none.
        cards: of the components, the model itself first.
        tabs: further parts of the page.
        footer: a last line.
    """

    title: str
    lead: str
    schematic: str
    cards: tuple[Card, ...]
    tabs: tuple[Tab, ...]
    footer: str = ""

    def __post_init__(self) -> None:
        need_text(self.title, "title")

    @property
    def plots(self) -> tuple[Plot, ...]:
        """All plots, in order of appearance."""
        cards = (s for card in self.cards for s in card.sections)
        tabs = (s for tab in self.tabs for s in tab.sections)
        return tuple(b for s in (*cards, *tabs) for b in s.blocks if isinstance(b, Plot))


def table(
    header: Sequence[str], rows: Sequence[Sequence[Any]], passed: Sequence[bool | None] = ()
) -> Table:
    """A table of anything that can be written."""
    cells = tuple(tuple(str(cell) for cell in row) for row in rows)
    return Table(tuple(header), cells, tuple(passed))


def titled_sections(titled: Mapping[str, Sequence[Block | None]]) -> tuple[Section, ...]:
    """Sections by title; what is None is left out, and so is a section without anything."""
    found = {t: tuple(b for b in blocks if b is not None) for t, blocks in titled.items()}
    return tuple(Section(title, blocks) for title, blocks in found.items() if blocks)
