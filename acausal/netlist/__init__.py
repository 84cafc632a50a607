"""Models as data: JSON netlists are read into components, and components are written as netlists.

In: a file's text, or a `Component`. Out: a `Component`, or a file.
It knows declarations and names of classes; no JAX, no flattening. Text is parsed, never run.
"""

from acausal.netlist.file import MAX_BYTES as MAX_BYTES, NetlistError as NetlistError
from acausal.netlist.finding import Found as Found, find as find
from acausal.netlist.library import Library as Library, installed as installed
from acausal.netlist.load_save import load as load, save as save
from acausal.netlist.writer import Writer as Writer
