"""Choices of options that several neural elements have, and a default of theirs."""

ZERO_CROSSING = (None, "regularizer", "offset", "exact")

FLOOR = 1e-3
"""Default of ``floor`` of a law that is solved for its argument: so its derivative does not vanish."""
