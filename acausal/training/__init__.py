"""`acausal.fit` and what it is made of: a problem (what to minimise), a trainer (how to step), a loop, a history."""
