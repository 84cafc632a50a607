"""`page`: a model, a simulation, estimates or a training as one HTML file that explains itself."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol, runtime_checkable

from acausal.errors import DataError, need_text, shown
from acausal.files import need_path, write_files
from acausal.modeling import Component
from acausal.pages.components import MOST_CARDS, Known, component_cards, schematic
from acausal.pages.trajectories import plots_by_unit, sensors
from acausal.reporting import PageContent, Section, Tab, render
from acausal.simulation import Solution, has_shapes
from acausal.system import System, compile as compile_model

POINTS = 3000
"""About so many points has a plot of a trajectory."""


@runtime_checkable
class WithPage(Protocol):
    """A result that tells about itself, such as `Fit`."""

    def page_content(self, title: str = "") -> PageContent:
        """All that its page shows."""
        ...


def page(
    subject: Component | System | Solution | WithPage, path: str | Path, title: str = ""
) -> Path:
    """Write a page that explains a model, a simulation, estimates or a training: one HTML file that needs no network.

    It shows the schematic and, for every component, its equations, parameters, trajectories and energy; of a training
    also records, learned laws and how sure they are; of estimates their bands and what sensors showed. With
    ``pip install 'acausal[page]'`` plots can be zoomed and read.

    Arguments:
        subject: a model, compiled or not, a `Solution`, estimates or a `Fit`.
        path: a folder, in which ``index.html`` is written, or a file that ends in ``.html``.
        title: headline; by default the model's name.

    Returns:
        The file.

    Raises:
        DataError: for a subject that has no page, or a file that cannot be written.
        ModelError: for a model that cannot be compiled.
    """
    page_path(path)
    if isinstance(subject, Component):
        subject = compile_model(subject)
    if isinstance(subject, WithPage):
        content = subject.page_content(title)
    elif isinstance(subject, System | Solution):
        content = model_content(subject, title)
    else:
        raise DataError(
            f"page: {shown(subject)} has no page; give a model, a Solution or a Fit, such as ac.page(fit, 'out')."
        )
    return write_page(content, path)


def write_page(content: PageContent, path: str | Path) -> Path:
    """Write a page; arguments and errors as of `page`."""
    file, text = page_path(path), render(content)
    write_files({file: text}, make_folders=True)
    return file


def page_path(path: str | Path) -> Path:
    """The file of a page: ``index.html`` in a folder, or the path itself if it ends in ``.html``."""
    found = need_path(path, "page")
    return found if found.suffix.lower() in (".html", ".htm") else found / "index.html"


def model_content(subject: System | Solution, title: str = "") -> PageContent:
    """What the page of a model tells, and of a simulation of it."""
    system = subject if isinstance(subject, System) else subject.system
    if isinstance(subject, Solution):
        known = Known(subject.packed.last, runs={"simulated": subject})
    else:
        known = Known(system.pack())
    return PageContent(
        need_text(title, "title") or system.flat.name,
        summary(system),
        schematic(system.model),
        component_cards(system, known),
        (*sensors(subject), *motion(subject), *_trajectories(subject))
        if isinstance(subject, Solution)
        else (),
    )


def summary(system: System) -> str:
    """A model's size in a sentence."""
    components = len(system.flat.layout.components)
    counts = {
        "component": components,
        "equation": system.flat.n_equations,
        "state": len(system.states),
        "input": len(system.inputs),
    }
    sentence = ", ".join(f"{n} {what}{'' if n == 1 else 's'}" for what, n in counts.items()) + "."
    some = f" {MOST_CARDS} components are shown: of long lists and within parts the first ones."
    more = some if components > MOST_CARDS else ""
    return sentence + more


def motion(solution: Solution) -> tuple[Tab, ...]:
    """The mechanism in motion, of a model that has shapes."""
    if not has_shapes(solution.system):
        return ()
    return (Tab("Motion", (Section("", (solution.animation(),)),)),)


def _trajectories(solution: Solution) -> tuple[Tab, ...]:
    """States and inputs over time, and what else a solution shows."""
    parts: list[Section] = []
    for heading, names in solution.groups.items():
        columns = solution.to_dict(names)
        time = columns.pop("time")
        units, sigma = {n: solution.unit(n) for n in names}, solution.deviations(names)
        steps = [n for n in solution.system.states if solution.system.is_discrete(n)]
        plots = plots_by_unit(
            time, columns, units, group="trajectories", most=POINTS, steps=steps, sigma=sigma
        )
        if plots:
            parts.append(Section(heading, tuple(plots)))
    return (Tab("Trajectories", tuple(parts)),) if parts else ()
