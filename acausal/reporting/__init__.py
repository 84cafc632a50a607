"""Report: plots, pages and diagrams.

In: arrays with names and units, a component tree. Out: matplotlib axes, HTML, SVG.
It does not know the classes of results, whose methods such as `Fit.report` call it: it takes plain data, or anything
with the attributes of a small protocol.
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
from acausal.reporting.profiles import add_profiles as add_profiles, plot_profile as plot_profile
from acausal.reporting.records import (
    add_predictions as add_predictions,
    add_records as add_records,
)
from acausal.reporting.sections import (
    LearnedLaw as LearnedLaw,
    add_divergences as add_divergences,
    add_laws as add_laws,
    add_losses as add_losses,
    add_parameters as add_parameters,
    add_residuals as add_residuals,
)
