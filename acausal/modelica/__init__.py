"""Modelica text: a file's classes become components, one Python class each.

In: the text of files, and values of their parameters. Out: a `Component`, as a netlist gives one.
It knows declarations and netlists; neither flattening nor JAX. Text is parsed, never run.
"""

from acausal.modelica.build import ModelicaModel as ModelicaModel
from acausal.modelica.grammar import parse as parse
from acausal.modelica.load import (
    ModelicaPackage as ModelicaPackage,
    import_modelica as import_modelica,
    load as load,
)
from acausal.modelica.tokens import (
    KEYWORDS as KEYWORDS,
    ModelicaError as ModelicaError,
    Source as Source,
    read_source as read_source,
)
