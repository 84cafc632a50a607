"""Constants of nature, with the values of `Modelica.Constants` (CODATA 2018)."""

from math import pi

k = 1.380649e-23
"""Boltzmann constant [J/K]."""

q = 1.602176634e-19
"""Elementary charge [C]."""

R = 8.31446261815324
"""Molar gas constant [J/(mol.K)]."""

F = 9.648533212331e4
"""Faraday constant [C/mol]."""

mu_0 = 4 * pi * 1.00000000055e-7
"""Magnetic constant [H/m]."""

g_n = 9.80665
"""Standard acceleration of gravity on earth [m/s2]."""
