"""Random numbers: the generator xorshift128+ (Vigna 2014, doi:10.1016/j.cam.2016.11.006).

Its state follows from two seeds by xorshift64*, as in the Modelica Standard Library: so the numbers are the same.
"""

from functools import lru_cache

import numpy as np

_WORD = 2**64 - 1


@lru_cache(maxsize=64)
def uniform(local_seed: int, global_seed: int, length: int) -> np.ndarray:
    """So many numbers in ]0, 1]."""
    word = local_seed & 0xFFFFFFFF | (global_seed & 0xFFFFFFFF) << 32
    word = word or 126247697
    for _ in range(10):
        word = _xorshift64(word)
    older, newer = word, _xorshift64(word)
    found = np.empty(length, np.uint64)
    for i in range(length):
        x = (older ^ older << 23) & _WORD
        older, newer = newer, ((x ^ newer ^ x >> 17 ^ newer >> 26) + newer) & _WORD
        found[i] = newer
    return found.view(np.int64) * 2.0**-64 + 0.5


def _xorshift64(word: int) -> int:
    word ^= word >> 12
    word ^= word << 25 & _WORD
    word ^= word >> 27
    return word * 2685821657736338717 & _WORD
