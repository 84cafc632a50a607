"""Reading by name: one name gives a column, a list of names gives columns side by side."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Any

from acausal.errors import DataError, shown


class ByName(ABC):
    """What can be read by name, as a pandas DataFrame can.

    ``thing["a"]`` is one column; ``thing[["a", "b"]]`` has two columns, on its last axis; ``"a" in thing`` asks
    whether there is such a name; iteration goes through the names.
    """

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""

    @abstractmethod
    def _column(self, name: str) -> Any:
        """The values of one name."""

    @abstractmethod
    def _side_by_side(self, names: tuple[str, ...]) -> Any:
        """The values of several names, on a last axis of their own."""

    def __getitem__(self, name: Any) -> Any:
        """The values of one name; those of several, in the order asked, on a last axis of their own.

        Raises:
            DataError: for an unknown name, or what is no name.
        """
        if isinstance(name, str):
            return self._column(str(name))
        return self._side_by_side(names_in(name))

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)


def names_in(given: Any, argument: str = "") -> tuple[str, ...]:
    """Names as Python's own texts: those of one text, or of any iterable of texts (NumPy's and pandas' too).

    Arguments:
        given: the names.
        argument: of the function that was called with them, for the message.

    Raises:
        DataError: for anything else.
    """
    if isinstance(given, str):
        return (str(given),)
    try:
        names: tuple[object, ...] = tuple(given)
    except TypeError:
        names = (given,)
    for name in names:
        if not isinstance(name, str):
            where = f"{argument}: " if argument else ""
            raise DataError(
                f"{where}{shown(name)} is not a name; give a text such as 'mass.s', or a list."
            )
    return tuple(map(str, names))
