"""Units: values converted from one unit to another, and equations checked for dimensions.

In: units as text, a `FlatModel`. Out: converted values, or a `UnitError` that names the equation.
It knows flat models; neither JAX nor structure.
"""

from acausal.units.check import check_dimensions as check_dimensions
from acausal.units.si import InSI as InSI, convert as convert, in_si as in_si
