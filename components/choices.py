"""Choices of options that components of several domains have."""

STATE_SELECT = ("never", "avoid", "default", "prefer", "always")
"""How strongly a variable is preferred as a state: the choices of ``stateSelect``, as in Modelica."""
