"""Copies of frozen objects without what they have computed and kept."""

from __future__ import annotations

from dataclasses import fields
from typing import Any


class LeavesCaches:
    """Base of frozen dataclasses whose cached properties stay behind when they are copied or pickled.

    What they keep may hold for one process only, such as a hash of text or an ``id``, or may not be picklable, such as
    a compiled function. A copy computes it again.
    """

    def __getstate__(self) -> dict[str, Any]:
        """The fields alone."""
        return {f.name: getattr(self, f.name) for f in fields(self)}  # pyright: ignore[reportArgumentType]
