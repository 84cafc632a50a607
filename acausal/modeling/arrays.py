"""Arrays in equations: NumPy's, of symbols and expressions, element by element."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from acausal.errors import DeclarationError


class Elements(np.ndarray):
    """An array of symbols; what NumPy computes of it is an array of expressions, and a comparison one of conditions."""

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        """What NumPy has computed; a single expression is no array."""
        return array.view(Elements) if array.ndim else array[()]

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        """What a function of NumPy gives: where that is an array of expressions, one of these, too."""
        found = super().__array_function__(func, types, args, kwargs)
        return found.view(Elements) if is_array(found) and found.dtype == object else found

    def __lt__(self, other: Any) -> Any:
        return np.less(self, other, dtype=object)

    def __le__(self, other: Any) -> Any:
        return np.less_equal(self, other, dtype=object)

    def __gt__(self, other: Any) -> Any:
        return np.greater(self, other, dtype=object)

    def __ge__(self, other: Any) -> Any:
        return np.greater_equal(self, other, dtype=object)

    def __contains__(self, one: object) -> bool:
        return any(one is each for each in self.flat)

    def __bool__(self) -> bool:
        raise DeclarationError(
            "Python asks whether an array of variables is true, but their values are not known yet: use ac.where."
        )


def elements(shape: tuple[int, ...], symbols: Iterable[Any]) -> Elements:
    """The read-only array of some symbols, whose last index changes first."""
    found = np.empty(shape, dtype=object).view(Elements)
    for place, symbol in zip(np.ndindex(shape), symbols, strict=True):
        found[place] = symbol
    found.setflags(write=False)
    return found


def is_array(value: Any) -> bool:
    """Whether a value is an array, of numbers or of expressions."""
    return isinstance(value, np.ndarray) and value.ndim > 0


def elementwise(function: Callable[..., Any], *arguments: Any) -> Any:
    """What a function of single values gives, of arrays element by element; single values go with each of them."""
    if not any(map(is_array, arguments)):
        return function(*arguments)
    return np.vectorize(function, otypes=[object])(*arguments).view(Elements)


def pairs(left: Any, right: Any, what: str) -> Iterator[tuple[Any, Any]]:
    """Two sides element by element; a single value on the right goes with all on the left.

    Raises:
        DeclarationError: for sides of unlike shapes.
    """
    one, other = np.asarray(left, dtype=object), np.asarray(right, dtype=object)
    if other.ndim and one.shape != other.shape:
        raise DeclarationError(
            f"{what} has {_size(one.shape)} on the left and {_size(other.shape)} on the right."
        )
    return zip(one.flat, np.broadcast_to(other, one.shape).flat, strict=True)


def _size(shape: tuple[int, ...]) -> str:
    return f"an array of shape {shape}" if shape else "a single value"
