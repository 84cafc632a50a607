"""The pictures of the library's classes, in a few strokes each; a class states its own as ``ICON``."""

from .electrical import *
from .mechanics import *
from .nature import *
from .shapes import *
from .signals import *
