"""What `acausal.simulate` is made of: inputs, solvers, fixed and adaptive steps, and the solution."""
