"""Simulation with events: steps end where a condition changes, discrete variables are found anew, states jump.

In: a `Run` of a model with events. Out: a `Solution`.
"""

from acausal.simulation.hybrid.over_rows import integrate_with_events as integrate_with_events
from acausal.simulation.hybrid.simulate_hybrid import simulate_hybrid as simulate_hybrid
