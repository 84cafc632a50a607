"""The liquid that components carry by default."""

RHO = 1000.0
"""Density of water [kg/m3]."""
