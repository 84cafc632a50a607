"""Modelica text: tokens with their places, and a syntax tree of classes, equations and algorithms.

In: the text of a file. Out: its classes, as a tree whose nodes know where they stand.
It knows neither components nor JAX. Text is parsed, never run.
"""

from acausal.modelica.grammar import parse as parse
from acausal.modelica.tokens import (
    ModelicaError as ModelicaError,
    Source as Source,
    read_source as read_source,
)
