"""Simulate: a compiled model is integrated over time.

In: a `System`, inputs, parameters. Out: a `Solution`, any variable of it by name.
It knows nothing of training; it calls `acausal.reporting` to draw.
"""

from acausal.simulation.fixed_steps import (
    Integrated as Integrated,
    Parts as Parts,
    Runs as Runs,
    Steps as Steps,
    inner_fractions as inner_fractions,
    integrate as integrate,
    on_curve as on_curve,
)
from acausal.simulation.inputs import (
    TimeFunction as TimeFunction,
    announce_inputs as announce_inputs,
    evaluate_all as evaluate_all,
    functions_of_time as functions_of_time,
)
from acausal.simulation.log import Log as Log
from acausal.simulation.motion import has_shapes as has_shapes
from acausal.simulation.newton import (
    GROWS as GROWS,
    KAPPA as KAPPA,
    LEAST as LEAST,
    OF_STALL as OF_STALL,
    SLOW as SLOW,
    STAGE_STEPS as STAGE_STEPS,
    STAGE_TOLERANCE as STAGE_TOLERANCE,
    STALLS as STALLS,
)
from acausal.simulation.run import check_clocks as check_clocks, limits_of as limits_of
from acausal.simulation.sampled_inputs import (
    Samples as Samples,
    polynomials_over_steps as polynomials_over_steps,
)
from acausal.simulation.simulate import simulate as simulate
from acausal.simulation.sliders import sliders as sliders
from acausal.simulation.solution import Solution as Solution
from acausal.simulation.solvers import (
    BDF as BDF,
    EXPLICIT as EXPLICIT,
    RK4 as RK4,
    STABILITY_LIMIT as STABILITY_LIMIT,
    Scheme as Scheme,
    Solver as Solver,
    for_adaptive_steps as for_adaptive_steps,
    for_fixed_steps as for_fixed_steps,
    is_bdf as is_bdf,
    solver_named as solver_named,
)
from acausal.simulation.stability import (
    fastest_mode as fastest_mode,
    long_steps as long_steps,
    modes as modes,
)
from acausal.simulation.steps import (
    BY_RATES as BY_RATES,
    CHATTERING as CHATTERING,
    DEADBAND_GROWTH as DEADBAND_GROWTH,
    NEAR as NEAR,
    Adaptive as Adaptive,
    check_tolerances as check_tolerances,
    integrate_in_steps as integrate_in_steps,
)
from acausal.simulation.sweep import Sweep as Sweep, sweep as sweep
from acausal.simulation.tableau import Tableau as Tableau, tableau_of as tableau_of
