"""A single-track vehicle: the tyres of both axles, learned from a campaign of manoeuvres."""
