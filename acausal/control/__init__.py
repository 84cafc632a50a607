"""Control: a model decides what its inputs should be.

In: a `System`, goals and limits. Out: plans, and closed loops with another model as the plant.
It hands the model to CasADi and IPOPT through `acausal.export`; it knows nothing of training.
"""

from acausal.control.mpc import MPC as MPC, Plan as Plan, mpc as mpc
