"""What `acausal.fit` is made of: a problem (what to minimise), a trainer (how to step), a loop and its history."""
