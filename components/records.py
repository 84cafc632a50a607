"""Media, materials and constants that a netlist may name, by the last word of their Modelica name."""

from typing import Any

from . import constants
from .fluid import media

RECORDS: dict[str, Any] = {
    **{name: value for name, value in vars(constants).items() if name.startswith("alpha20")},
    **{
        name: cls()
        for name, cls in vars(media).items()
        if isinstance(cls, type) and issubclass(cls, media.Medium)
    },
}
"""Name -> record or number."""
