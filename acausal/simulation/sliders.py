"""Sliders for parameters and inputs, in a notebook: moving one simulates the compiled model again."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal._jax import is_number
from acausal.errors import (
    AcausalError,
    DataError,
    known_name,
    need_compiled,
    need_package,
    shown,
)
from acausal.modeling import by_name, names_in
from acausal.simulation.simulate import simulate
from acausal.simulation.solution import Solution

if TYPE_CHECKING:
    from acausal.system import System

LOGARITHMIC = 20.0
"""A slider whose positive bounds are further apart than by this factor is logarithmic."""

Ranges = Mapping[str, tuple[float, float]] | str | Sequence[str]

FACTOR = 4.0
"""A parameter without bounds varies by so much."""

STEPS = 200
"""Positions of a slider."""


@dataclass(frozen=True)
class Range:
    """What a slider moves.

    Attributes:
        name: of a parameter or an input. low, high: the bounds. value: at the beginning. unit: of all three.
    """

    name: str
    low: float
    high: float
    value: float
    unit: str

    @property
    def logarithmic(self) -> bool:
        """Whether equal ways on the slider are equal factors."""
        return self.low > 0 and self.high / self.low > LOGARITHMIC


def sliders(
    system: System,
    t: float | tuple[float, float],
    ranges: Ranges = (),
    *,
    show: str | Sequence[str] = (),
    params: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    **options: Any,
) -> Any:
    """Sliders that simulate a model again when they are moved, with a plot that follows. Nothing is compiled again.

    Arguments:
        system: a compiled model.
        t: start and end of the simulations, or the end if they start at 0, in seconds.
        ranges: by parameter, or by input that is to be constant, the least and the largest value. A list of parameters
            lets each vary by a factor of four, within the bounds that it declares.
        show: variables to plot; by default the states.
        params, inputs: as for `acausal.simulate`, for what no slider moves.
        options: further arguments of `acausal.simulate`.

    Returns:
        An ``ipywidgets`` box: a notebook shows it where it is a cell's result.

    Raises:
        AcausalError: if ipywidgets is not installed.
        DataError: for a name that is neither a parameter nor an input, bounds that are none, or what
            `acausal.simulate` refuses.
    """
    need_compiled(system, "sliders")
    if isinstance(t, str | Mapping) or (
        isinstance(t, Sequence) and any(isinstance(v, str) for v in t)
    ):
        raise DataError(
            f"sliders: t={shown(t)} is not a time; give it first, ac.sliders(system, 10.0, {shown(t)})."
        )
    widgets = need_package("ipywidgets", "sliders", "notebook", AcausalError)
    for argument, given in (("params", params), ("inputs", inputs)):
        by_name(given, argument, "values by name")
    moved = Moved(
        system, ranges_of(system, ranges, params), t, show, params or {}, inputs or {}, options
    )
    picture = widgets.HTML(moved.picture({r.name: r.value for r in moved.ranges}))
    knobs = {r.name: _slider(widgets, r) for r in moved.ranges}

    def follow(change: Any) -> None:
        del change
        picture.value = moved.picture({name: knob.value for name, knob in knobs.items()})

    for knob in knobs.values():
        knob.observe(follow, names="value")
    return widgets.VBox([*knobs.values(), picture])


@dataclass(frozen=True)
class Moved:
    """A model, what sliders move in it, and how it is simulated: pictures of runs, without widgets.

    Attributes:
        ranges: what is moved. t, params, inputs, options: of the simulations. show: what is plotted.
    """

    system: System
    ranges: tuple[Range, ...]
    t: float | tuple[float, float]
    show: str | Sequence[str]
    params: Mapping[str, Any]
    inputs: Mapping[str, Any]
    options: Mapping[str, Any]

    def run(self, values: Mapping[str, float]) -> Solution:
        """The simulation with these values of parameters and inputs."""
        known = self.system.inputs
        inputs = {**self.inputs, **{n: v for n, v in values.items() if n in known}}
        params = {**(self.params or self.system.parameters())}
        params |= {n: v for n, v in values.items() if n not in known}
        return simulate(self.system, self.t, inputs=inputs, params=params, **self.options)

    def picture(self, values: Mapping[str, float]) -> str:
        """The plot as HTML; where a run fails, the sentence that says why."""
        from acausal.reporting import Curve, small_plot

        try:
            run = self.run(values)
        except AcausalError as error:
            return f"<p>{html.escape(str(error))}</p>"
        names = names_in(self.show, "show") or self.system.states
        groups: dict[str, list[Curve]] = {}
        for name in names:
            curve = Curve(
                name, np.asarray(run.t), np.asarray(run[name]), steps=self.system.is_discrete(name)
            )
            groups.setdefault(self.system.unit(name), []).append(curve)
        return "".join(
            small_plot(curves, across="time in s", upwards=unit or "1")
            for unit, curves in groups.items()
        )


def ranges_of(
    system: System,
    ranges: Ranges,
    params: Mapping[str, Any] | None = None,
) -> tuple[Range, ...]:
    """The sliders' ranges, checked; their values are the parameters', or the middle for an input.

    Raises:
        DataError: for a name that is neither, or bounds that are none.
    """
    known = (*system.layout.names, *system.inputs)
    given = params or system.parameters()
    system.pack(given)
    found: list[Range] = []
    if not isinstance(ranges, Mapping):
        ranges = {name: _around(system, name, given) for name in names_in(ranges, "ranges")}
    for name, bounds in ranges.items():
        known_name(name, known, "ranges:", then=" is neither a parameter nor an input;")
        if (
            not isinstance(bounds, Sequence)
            or len(bounds) != 2
            or not all(map(is_number, bounds))
            or not bounds[0] < bounds[1]
        ):
            raise DataError(
                f"ranges: '{name}' goes from {shown(bounds)}; give the least and the largest value."
            )
        low, high = map(float, bounds)
        value = float(given[name]) if name in given else 0.5 * (low + high)
        found.append(Range(name, low, high, min(max(value, low), high), system.unit(name)))
    return tuple(found)


def _around(system: System, name: str, params: Mapping[str, Any]) -> tuple[float, float]:
    """Bounds by `FACTOR` around a parameter's value, within those that it declares."""
    value = float(params.get(name, 0.0))
    if name in params and not value:
        raise DataError(f"ranges: '{name}' is 0; give the least and the largest value by name.")
    least, largest = system.layout.range_of(name) if name in params else (-np.inf, np.inf)
    low, high = sorted((value / FACTOR, value * FACTOR))
    return max(low, least), min(high, largest)


def _slider(widgets: Any, one: Range) -> Any:
    look = {
        "description": f"{one.name} [{one.unit or '1'}]",
        "readout_format": ".4g",
        "style": {"description_width": "14em"},
        "layout": widgets.Layout(width="42em"),
    }
    if one.logarithmic:
        low, high = np.log10([one.low, one.high]).tolist()
        return widgets.FloatLogSlider(
            one.value, base=10, min=low, max=high, step=(high - low) / STEPS, **look
        )
    return widgets.FloatSlider(
        one.value, min=one.low, max=one.high, step=(one.high - one.low) / STEPS, **look
    )
