"""Measured swings of a double pendulum: its arms from their masses, its joints' friction learned."""
