"""The page of a model: a frozen record of all that it tells, and the HTML file that shows it."""

from acausal.reporting.document.builder import Page as Page, write_json as write_json
from acausal.reporting.document.content import (
    Block as Block,
    Card as Card,
    Curve as Curve,
    Drawing as Drawing,
    Equations as Equations,
    PageContent as PageContent,
    Plot as Plot,
    Role as Role,
    Section as Section,
    Tab as Tab,
    Table as Table,
    Text as Text,
    table as table,
    titled_sections as titled_sections,
)
from acausal.reporting.document.library import plot_library as plot_library
from acausal.reporting.document.picture import small_plot as small_plot
from acausal.reporting.document.render import render as render
from acausal.reporting.document.thinning import (
    broken_at_gaps as broken_at_gaps,
    kept_rows as kept_rows,
    thinned as thinned,
)
