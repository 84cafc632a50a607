"""Models as data: JSON netlists are read into components, and components are written as netlists.

In: a file's text, or a `Component`. Out: a `Component`, or a file.
It knows declarations and names of classes; no JAX, no flattening. Text is parsed, never run.
"""

from acausal.netlist.arithmetic import Arithmetic as Arithmetic
from acausal.netlist.file import MAX_BYTES as MAX_BYTES, NetlistError as NetlistError
from acausal.netlist.finding import FoundClasses as FoundClasses, find as find
from acausal.netlist.grammar import Grammar as Grammar
from acausal.netlist.library import (
    Library as Library,
    find_class as find_class,
    installed as installed,
)
from acausal.netlist.load_save import (
    check_sizes as check_sizes,
    libraries_of as libraries_of,
    read_model as read_model,
    save as save,
)
from acausal.netlist.model import attribute as attribute, member as member
from acausal.netlist.modifiers import is_structural as is_structural, make as make, modify as modify
from acausal.netlist.scope import Scope as Scope, evaluated as evaluated
from acausal.netlist.vocabulary import (
    BARE_CONSTANTS as BARE_CONSTANTS,
    CONSTANTS as CONSTANTS,
    function as function,
)
from acausal.netlist.writer import Writer as Writer, lies_within as lies_within
