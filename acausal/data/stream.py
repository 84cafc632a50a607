"""Records that are read when they are needed, because all of them do not fit in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from acausal.errors import DataError, nearest


@dataclass(frozen=True, eq=False)
class Stream:
    """Records by name that stay in their files: ``stream["run 7"]`` reads one, ``dict(stream)`` reads all.

    `Data.stream` makes it; `acausal.fit` trains on it with ``strategy="sequences"``.

    Attributes:
        sources: by name, the function that reads the record.
    """

    sources: Mapping[str, Callable[[], Any]]

    def keys(self) -> Iterator[str]:
        """Names of the records."""
        return iter(self.sources)

    def __iter__(self) -> Iterator[str]:
        return iter(self.sources)

    def __len__(self) -> int:
        return len(self.sources)

    def __getitem__(self, name: str) -> Any:
        if name not in self.sources:
            raise DataError(f"There is no record '{name}': {nearest(name, self.sources)}")
        return self.sources[name]()

    def without(self, names: tuple[str, ...]) -> Stream:
        """The other records."""
        return Stream({n: read for n, read in self.sources.items() if n not in names})

    def __repr__(self) -> str:
        first = ", ".join(f"'{name}'" for name in list(self.sources)[:3])
        count = len(self)
        return f"Stream({count} record{'s' * (count > 1)}, read when needed: {first}{', ...' * (count > 3)})"
