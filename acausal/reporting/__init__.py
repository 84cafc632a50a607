"""Reports: plots, pages and diagrams.

In: arrays with names and units, a component tree. Out: matplotlib axes, HTML, SVG.
It knows no results: a result that can be shown calls it.
"""

from acausal.reporting.diagram import diagram as diagram
from acausal.reporting.html import Page as Page, write_json as write_json
from acausal.reporting.over_time import plot_over_time as plot_over_time
from acausal.reporting.plot import (
    GUIDE as GUIDE,
    LEARNED as LEARNED,
    TRUTH as TRUTH,
    plot_band as plot_band,
    plot_guides as plot_guides,
    plot_learned as plot_learned,
    plot_losses as plot_losses,
    plot_modifiers as plot_modifiers,
)
