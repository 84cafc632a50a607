"""Reading by name: one name gives a column, a list of names gives columns side by side."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from operator import getitem
from typing import Any

import numpy as np
from numpy.typing import NDArray

from acausal.errors import DataError, nearest, shown
from acausal.modeling.declarations import element_names

INDICES = re.compile(r"\d+(,\d+)*\]")
"""How the name of an array's element ends."""


class ByName(ABC):
    """What can be read by name, as a pandas DataFrame can.

    ``thing["a"]`` is one column, of an array one for each element; ``thing[["a", "b"]]`` has two columns, on its last
    axis; ``"a" in thing`` asks whether there is such a column; iteration goes through their names.
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

        The name of an array gives that of its elements, on last axes of the array's shape.

        Raises:
            DataError: for an unknown name, or what is not a name.
        """
        if not isinstance(name, str):
            return self._side_by_side(names_in(name))
        try:
            return self._column(str(name))
        except DataError:
            elements = elements_of(name, self.names)
            if elements is None:
                raise
        side_by_side = self._side_by_side(tuple(elements.ravel().tolist()))
        return side_by_side.reshape(*side_by_side.shape[:-1], *elements.shape)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def _ipython_key_completions_(self) -> list[str]:
        """What a notebook offers after ``thing["``."""
        return list(self.names)


class Name(str):
    """A dotted name that offers the names below it: ``system.motor.i`` is the text ``"motor.i"``.

    It is for typing with the help of completion: anything that takes a name takes it. Elements of vectors are
    ``name[1]``, and a name that is also a method of texts, such as ``count``, is reached by ``name["count"]``.
    """

    __slots__ = ("_known",)
    _known: tuple[str, ...]

    def __new__(cls, text: str, known: Iterable[str]) -> Name:
        """The name, and all names that begin with it."""
        name = super().__new__(cls, text)
        name._known = tuple(n for n in known if n == text or n[len(text) : len(text) + 1] in ".[")
        return name

    def __getattr__(self, word: str) -> Name:
        if word.startswith("_"):
            raise AttributeError(word)
        return self._below(f".{word}", word)

    def __getitem__(self, key: Any) -> Any:
        """An element of a vector by its number, from 1; or a name below. Slices are those of the text."""
        if isinstance(key, slice):
            return super().__getitem__(key)
        return self._below(f".{key}" if isinstance(key, str) else f"[{key}]", key)

    def _below(self, further: str, word: object) -> Name:
        text = f"{self}{further}"
        known = [n for n in self._known if n.startswith(text)]
        if not (found := Name(text, known))._known:
            raise AttributeError(
                f"'{self}' has no '{word}'; {nearest(word, words_below(self, self._known))}"
            )
        return found

    def __reduce__(self) -> tuple[type[str], tuple[str]]:
        """Copies are plain texts."""
        return str, (str(self),)

    def __dir__(self) -> list[str]:
        return words_below(self, self._known)

    _ipython_key_completions_ = __dir__


def full_name(path: str, name: str) -> str:
    """The full name of what a component calls so; the path of the model itself is empty."""
    return f"{path}.{name}" if path else name


def names_matching(given: Any, known: Sequence[str]) -> tuple[str, ...]:
    """Names, and those that patterns stand for: ``"c.*"`` the names directly below ``c``, ``"c.**"`` all below.

    Arguments:
        given: names or patterns: a text, or an iterable of texts. ``?`` stands for one letter.
        known: the names that a pattern may stand for.

    Raises:
        DataError: for what is not a name, or a pattern that nothing fits.
    """
    found: dict[str, None] = {}
    for name in names_in(given):
        if "*" not in name and "?" not in name:
            found[name] = None
            continue
        parts = re.split(r"(\*\*|\*|\?)", name)
        wild = {"**": ".+", "*": r"[^.]+", "?": r"[^.]"}
        pattern = re.compile("".join(wild.get(part, re.escape(part)) for part in parts))
        fitting = [n for n in known if pattern.fullmatch(n)]
        if not fitting:
            raise DataError(
                f"No variable is called '{name}'; '*' stands for a part between dots, '**' for any."
            )
        found |= dict.fromkeys(fitting)
    return tuple(found)


def words_below(name: str, known: Iterable[str]) -> list[str]:
    """The next words of the names below a dotted one, each once."""
    below = (n[len(name) + 1 :] for n in known if n.startswith(f"{name}."))
    return list(dict.fromkeys(re.split(r"[.\[(]", rest)[0] for rest in below))


def by_name(given: Any, argument: str, example: str) -> dict[str, Any]:
    """What is given by name, the names as Python's own texts; nothing for None.

    Arguments:
        given: what the user gave. argument: what that is called. example: what to give instead, for the message.

    Raises:
        DataError: for what has no names.
    """
    if not isinstance(given, Mapping | None):
        raise DataError(f"{argument}={shown(given)} has no names; give {example}.")
    return {name: given[name] for name in names_in(given, argument)} if given is not None else {}


def with_elements(names: Iterable[str], known: Collection[str]) -> tuple[str, ...]:
    """The same names, with those of their elements in the place of arrays."""
    found: list[str] = []
    for name in names:
        elements = None if name in known else elements_of(name, known)
        found += [name] if elements is None else elements.ravel().tolist()
    return tuple(found)


def elements_of(name: str, known: Iterable[str]) -> NDArray[np.str_] | None:
    """The names of an array's elements, in its shape; None where the known names have no whole array of that name."""
    begin = len(name) + 1
    found = {n for n in known if n.startswith(f"{name}[") and INDICES.fullmatch(n, begin)}
    indices = [tuple(map(int, n[begin:-1].split(","))) for n in found]
    if len({len(index) for index in indices}) != 1:
        return None
    shape = tuple(map(max, zip(*indices, strict=True)))
    names = element_names(name, shape)
    return np.asarray(names).reshape(shape) if found.issuperset(names) else None


def by_element(
    given: Mapping[str, Any], known: Collection[str], argument: str, *, sampled: bool = False
) -> Mapping[str, Any]:
    """The same, arrays that are given as a whole by their elements: ``{"x": [1, 2]}`` as ``{"x[1]": 1, "x[2]": 2}``.

    Arguments:
        given: by name, what belongs to it; of an array, nested lists of its shape, or numbers with its shape as last
            axes.
        known: the names that there are. argument: what is given, for messages.
        sampled: whether it may be a pair of times and such numbers.

    Raises:
        DataError: for another shape, and for an element that is given twice.
    """
    known = frozenset(known)
    if known.issuperset(given):
        return given
    found: dict[str, Any] = {}
    for name in names_in(given, argument):
        one, elements = {name: given[name]}, None if name in known else elements_of(name, known)
        if elements is not None:
            one = _divided(elements, given[name], f"{argument}: '{name}'", sampled)
        if twice := found.keys() & one.keys():
            raise DataError(
                f"{argument}: '{min(twice)}' is given twice, by itself and within its array."
            )
        found |= one
    return found


def _divided(elements: NDArray[np.str_], value: Any, what: str, sampled: bool) -> dict[str, Any]:
    """By element, its part of the values of an array."""
    shape, places = elements.shape, [*np.ndindex(elements.shape)]
    if _is_nested(value, shape):
        return {str(elements[i]): reduce(getitem, i, value) for i in places}
    if callable(value):
        raise DataError(
            f"{what} is an array of shape {shape}; give a list of one for each element."
        )
    if sampled and isinstance(value, tuple) and len(value) == 2:
        times, samples = value
        parts = _divided(elements, samples, what, False)
        return {name: (times, part) for name, part in parts.items()}
    try:
        numbers: Any = value if hasattr(value, "aval") else np.asarray(value)
    except ValueError:
        raise DataError(f"{what} is an array of shape {shape}, not {shown(value)}.") from None
    if (own := np.shape(numbers))[max(len(own) - len(shape), 0) :] != shape:
        raise DataError(f"{what} is an array of shape {shape}; its values have the shape {own}.")
    return {str(elements[i]): numbers[(..., *i)] for i in places}


def _is_nested(value: Any, shape: tuple[int, ...]) -> bool:
    """Whether lists or tuples in each other have a shape, with something that has none in each place."""
    if not shape:
        return not isinstance(value, list | tuple) and getattr(value, "ndim", 0) == 0
    is_list = isinstance(value, list | tuple) and len(value) == shape[0]
    return is_list and all(_is_nested(part, shape[1:]) for part in value)


def antiderivatives(name: str) -> tuple[str, ...]:
    """A name, and what it is a derivative of: ``der(der(u))``, ``der(u)``, ``u``."""
    inner = name.startswith("der(") and name.endswith(")")
    return (name, *antiderivatives(name[4:-1])) if inner else (name,)


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
