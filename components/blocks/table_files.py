"""Tables in files: Modelica's text format, comma separated values, MATLAB's MAT files."""

import re
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac

_HEAD = re.compile(r"^\s*(?:double|float)\s+(\w+)\s*\(\s*(\d+)[\s,]+(\d+)\s*\)", re.MULTILINE)


def from_file(path: str, name: str, delimiter: str, n_header: int) -> np.ndarray:
    """The table of a name in a file, shape (rows, columns); files ``.csv`` have one without a name.

    Raises:
        DeclarationError: for a file that cannot be read, or has no such table.
    """
    file = Path(path)
    if not file.is_file():
        raise ac.DeclarationError(f"fileName={path!r}: there is no such file")
    return _read(file, name, delimiter, int(n_header), file.stat().st_mtime_ns).copy()


@lru_cache(maxsize=32)
def _read(file: Path, name: str, delimiter: str, n_header: int, _changed: int) -> np.ndarray:
    try:
        if file.suffix.lower() == ".csv":
            return np.loadtxt(
                file, delimiter=delimiter, skiprows=n_header, ndmin=2, encoding="utf-8-sig"
            )
        if file.suffix.lower() == ".mat":
            return _from_mat(file, name)
        return _from_text(file.read_text(encoding="utf-8-sig"), file.name, name)
    except (OSError, ValueError, NotImplementedError) as error:
        raise ac.DeclarationError(f"fileName={str(file)!r} cannot be read: {error}") from error


def _from_text(text: str, file: str, name: str) -> np.ndarray:
    heads = list(_HEAD.finditer(text))
    if not text.startswith("#1"):
        raise ac.DeclarationError(f"{file} does not begin with '#1'")
    for head, end in zip(heads, [*(h.start() for h in heads[1:]), len(text)], strict=True):
        if head[1] != name:
            continue
        lines = text[head.end() : end].splitlines()
        numbers = " ".join(re.split(r"#|//", line)[0] for line in lines)
        shape = int(head[2]), int(head[3])
        values = [float(word) for word in re.split(r"[\s,;]+", numbers) if word]
        if len(values) < shape[0] * shape[1]:
            raise ac.DeclarationError(
                f"{file}: the table '{name}' has {len(values)} numbers, not {shape[0]} times {shape[1]}"
            )
        return np.reshape(values[: shape[0] * shape[1]], shape)
    raise _missing(file, name, [head[1] for head in heads])


def _from_mat(file: Path, name: str) -> np.ndarray:
    from scipy.io import loadmat

    found: dict[str, Any] = loadmat(file)
    if name in found:
        return np.asarray(found[name], dtype=float)
    raise _missing(file.name, name, [key for key in found if not key.startswith("__")])


def _missing(file: str, name: str, known: list[str]) -> ac.DeclarationError:
    return ac.DeclarationError(
        f"{file} has no table '{name}'; it has {', '.join(known[:12]) or 'none'}"
    )
