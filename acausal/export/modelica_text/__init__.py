"""Modelica text: components as classes, networks as blocks.

In: a component tree and the networks in it. Out: text.
It knows no simulation; Modelica's names of the library's classes are the library's.
"""

from acausal.export.modelica_text.package import Package as Package, package_of as package_of
from acausal.export.modelica_text.spelling import class_name as class_name
