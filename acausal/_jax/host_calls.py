"""Calls from compiled programs to Python functions of addresses, by one handler of XLA's foreign functions.

A call takes numbers and gives numbers; the first number that it takes says which function is called. So a new function
compiles nothing, and the handler reads memory where it lies: a call takes microseconds, where a callback of JAX's takes
some hundred. The structures are those of ``xla/ffi/api/c_api.h``.
"""

from __future__ import annotations

import ctypes as C
from collections.abc import Callable
from functools import cache

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

Call = Callable[[int, int], object]
"""A function of two addresses: of the numbers that it takes, and of those that it gives."""

BYTES = C.sizeof(C.c_double)
NAME = "acausal_host"
VERSION = (0, 1)
DOUBLE = 12
INTERNAL = 13


class _Buffer(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.c_void_p), ("kind", C.c_int), ("data", C.c_void_p),
        ("rank", C.c_int64), ("sizes", C.POINTER(C.c_int64)),
    )  # fmt: skip


class _Buffers(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.c_void_p), ("count", C.c_int64), ("kinds", C.c_void_p),
        ("each", C.POINTER(C.POINTER(_Buffer))),
    )  # fmt: skip


class _Version(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.c_void_p), ("major", C.c_int), ("minor", C.c_int),
    )  # fmt: skip


class _Metadata(C.Structure):
    _fields_ = (("size", C.c_size_t), ("version", _Version), ("traits", C.c_uint32))


class _Extension(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("kind", C.c_int), ("next", C.c_void_p), ("metadata", C.POINTER(_Metadata)),
    )  # fmt: skip


class _API(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.c_void_p), ("version", _Version), ("internal", C.c_void_p),
        ("error", C.CFUNCTYPE(C.c_void_p, C.c_void_p)),
    )  # fmt: skip


class _Error(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.c_void_p), ("message", C.c_char_p), ("code", C.c_int),
    )  # fmt: skip


class _Frame(C.Structure):
    _fields_ = (
        ("size", C.c_size_t), ("extension", C.POINTER(_Extension)), ("api", C.POINTER(_API)),
        ("context", C.c_void_p), ("stage", C.c_int), ("given", _Buffers), ("found", _Buffers),
    )  # fmt: skip


class HostError(Exception):
    """It ends the program that calls, where numbers that are not finite would not be explained: in derivatives."""


_CALLS: list[Call] = []

HOST_FAILURES: dict[int, str] = {}
"""By the number of a function, why it last gave no numbers."""


def register_host(call: Call) -> int:
    """A number by which compiled programs call a function; it holds for this process."""
    _registered()
    _CALLS.append(call)
    return len(_CALLS) - 1


def call_host(number: int, given: Float[Array, " n"], shape: tuple[int, ...]) -> Array:
    """The numbers that a registered function gives for what it takes, in that shape; NaN where it fails."""
    like = jax.ShapeDtypeStruct(shape, given.dtype)
    first = jnp.full((1,), number, given.dtype)
    return jax.ffi.ffi_call(NAME, like, vmap_method="broadcast_all")(
        jnp.concatenate([first, given])
    )


@cache
def _registered() -> None:
    jax.ffi.register_ffi_target(NAME, jax.ffi.pycapsule(_handle), platform="cpu")


@C.CFUNCTYPE(C.c_void_p, C.POINTER(_Frame))
def _handle(address: C._Pointer[_Frame]) -> int | None:  # pyright: ignore[reportPrivateUsage]
    frame = address[0]
    try:
        if frame.extension:
            version = frame.extension[0].metadata[0].version
            version.major, version.minor = VERSION
            return None
        given, found = frame.given.each[0][0], frame.found.each[0][0]
        width, rows, height = given.sizes[given.rank - 1], 1, 1
        for axis in range(given.rank - 1):
            rows *= given.sizes[axis]
        for axis in range(given.rank - 1, found.rank):
            height *= found.sizes[axis]
        if given.kind == DOUBLE:
            _call(given.data, found.data, rows, width, height)
        else:
            _call_single(given.data, found.data, rows, width, height)
        return None
    except BaseException as error:  # Ctrl-C, for example: none may pass through C
        message = f"{error}" if isinstance(error, HostError) else f"{type(error).__name__} {error}"
        described = _Error(C.sizeof(_Error), None, message.encode(), INTERNAL)
        return frame.api[0].error(C.addressof(described))


def _call(given: int, found: int, rows: int, width: int, height: int) -> None:
    number = C.c_double.from_address
    for _ in range(rows):
        which = int(number(given).value)
        try:
            _CALLS[which](given + BYTES, found)
        except HostError:
            raise
        except Exception as error:
            if str(error):
                HOST_FAILURES[which] = str(error)
            C.memset(found, 0xFF, BYTES * height)  # NaN
        given += BYTES * width
        found += BYTES * height


def _call_single(given: int, found: int, rows: int, width: int, height: int) -> None:
    """For programs in single precision: through copies."""
    taken = np.ctypeslib.as_array((C.c_float * (rows * width)).from_address(given)).astype(float)
    gives = np.zeros(rows * height)
    _call(taken.ctypes.data, gives.ctypes.data, rows, width, height)
    np.ctypeslib.as_array((C.c_float * (rows * height)).from_address(found))[:] = gives
