"""Choices of options that several neural elements have, and the least stiffness of their laws."""

ZERO_CROSSING = (None, "regularizer", "offset", "exact")

FLOOR = 1e-3
"""Default of ``floor`` that a monotone law's derivative is divided by."""
