"""Report: plots, pages and diagrams.

In: arrays with names and units, a component tree. Out: matplotlib axes, HTML, SVG.
It does not know the classes of results, whose methods such as `Fit.report` call it: it takes plain data, or anything
with the attributes of a small protocol.
"""

from acausal.reporting.document.builder import Page as Page, write_json as write_json
from acausal.reporting.document.content import (
    Animation as Animation,
    Block as Block,
    Card as Card,
    Curve as Curve,
    Drawing as Drawing,
    EquationList as EquationList,
    Moving as Moving,
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
from acausal.reporting.document.motion import still as still
from acausal.reporting.document.picture import small_plot as small_plot
from acausal.reporting.document.render import render as render
from acausal.reporting.document.thinning import (
    broken_at_gaps as broken_at_gaps,
    kept_rows as kept_rows,
    thinned as thinned,
)
from acausal.reporting.frequency import (
    plot_bode as plot_bode,
    plot_nyquist as plot_nyquist,
    plot_steps as plot_steps,
)
from acausal.reporting.model_view import (
    MOST_EQUATIONS as MOST_EQUATIONS,
    Formulas as Formulas,
    Quantity as Quantity,
    component_view as component_view,
    equations_as_latex as equations_as_latex,
    system_view as system_view,
)
from acausal.reporting.over_time import (
    plot_over_time as plot_over_time,
    plot_predictions as plot_predictions,
    plot_variants as plot_variants,
)
from acausal.reporting.plain_table import PlainTable as PlainTable, aligned as aligned
from acausal.reporting.plot import (
    GUIDE as GUIDE,
    LEARNED as LEARNED,
    TRUTH as TRUTH,
    Band as Band,
    InputStatistics as InputStatistics,
    one_axes as one_axes,
    plot_band as plot_band,
    plot_learned as plot_learned,
)
from acausal.reporting.short_names import Short as Short, shorten as shorten
from acausal.reporting.view import (
    Html as Html,
    View as View,
    html_table as html_table,
    number as number,
)
