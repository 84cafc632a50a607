"""Pages: what a model tells about itself, component by component.

In: a compiled model, trajectories. Out: a page.
It gathers what a page tells; `reporting` holds the record and renders it. A result of a later room joins in by its
method ``page_content``, as `Fit` does.
"""

from acausal.pages.components import (
    Known as Known,
    LearnedLaw as LearnedLaw,
    component_cards as component_cards,
    schematic as schematic,
)
from acausal.pages.page import (
    motion as motion,
    page as page,
    summary as summary,
    write_page as write_page,
)
from acausal.pages.parallel import parallel_law as parallel_law
from acausal.pages.trajectories import labelled as labelled
