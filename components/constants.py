"""Material constants of the Modelica Standard Library, by its names.

Temperature coefficients of resistance at 20 degC [1/K], of `Modelica.Electrical.Machines.Thermal.Constants`:
``alpha20Zero`` (no dependence), ``alpha20Aluminium``, ``alpha20Brass``, ``alpha20Bronze``,
``alpha20Copper``.
"""

alpha20Zero = 0.0
alpha20Aluminium = 4.000e-3
alpha20Brass = 1.100e-3
alpha20Bronze = 0.800e-3
alpha20Copper = 3.920e-3
