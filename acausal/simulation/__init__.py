"""`acausal.simulate` and what it is made of: inputs, solvers, fixed and adaptive steps, and the solution."""
