"""The compilation cache: compiled programs are kept on disk, so that a second run does not compile them again.

It is JAX's own cache, in the user's cache folder unless the user has set up another one. Programs that call Python, as
sparse factorizations do, are never kept. Whoever can write to the folder can make a program run code, so only the
user has access to it.
"""

from __future__ import annotations

import hashlib
import os
import platform
from collections.abc import Mapping
from pathlib import Path

from acausal.errors import DataError
from acausal.files import need_path

VARIABLE = "ACAUSAL_COMPILATION_CACHE"
"""The environment variable that names another folder, or says ``off``."""
OFF = ("", "0", "off")

FOLDER = "jax_compilation_cache_dir"
ENABLED = "jax_enable_compilation_cache"
SHORTEST = "jax_persistent_cache_min_compile_time_secs"
"""JAX's settings."""
SECOND = 1.0
"""JAX's own default. Programs of small models compile faster, and would not be kept."""


def begin(environment: Mapping[str, str]) -> None:
    """Keep compiled programs from now on, unless the user has turned this off or the folder cannot be written to."""
    chosen = environment.get(VARIABLE)
    set_up = _setting(FOLDER) is not None or not _setting(ENABLED)
    if set_up or (chosen is not None and chosen.lower() in OFF):
        return
    folder = default_folder(environment) if chosen is None else Path(chosen)
    if _usable(folder):
        _keep(folder)


def use_compilation_cache(path: str | os.PathLike[str] | None) -> None:
    """Keep compiled programs in a folder from now on, or nowhere.

    By default they are kept in ``acausal`` in the user's cache folder (``$XDG_CACHE_HOME`` or ``~/.cache``), unless a
    cache was set up for JAX before. The environment variable ``ACAUSAL_COMPILATION_CACHE`` names another folder, or
    says ``off``. A folder may be emptied at any time.

    Arguments:
        path: the folder, to which nobody else should be able to write; None for no cache.

    Raises:
        DataError: if nothing can be written there.
    """
    import jax
    from jax.experimental.compilation_cache.compilation_cache import reset_cache

    if path is None:
        jax.config.update(FOLDER, None)
    elif _usable(folder := need_path(path, "use_compilation_cache")):
        _keep(folder)
    else:
        raise DataError(f"no compiled programs can be written to '{path}'; name another folder")
    reset_cache()


def default_folder(environment: Mapping[str, str]) -> Path:
    """In the user's cache folder, one folder for each kind of processor, as machines may share home folders."""
    caches = environment.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(caches, "acausal", f"{platform.machine()}-{_processor()}")


def _keep(folder: Path) -> None:
    import jax

    jax.config.update(FOLDER, str(folder.expanduser().absolute()))
    if _setting(SHORTEST) == SECOND:
        jax.config.update(SHORTEST, 0.0)


def _setting(name: str) -> object:
    import jax

    return getattr(jax.config, name)


def _usable(folder: Path) -> bool:
    """Whether files can be written to a folder; it is created if it does not exist."""
    try:
        made = folder.expanduser()
        made.mkdir(mode=0o700, parents=True, exist_ok=True)
    except (OSError, RuntimeError):  # nothing may be written there, or there is no home
        return False
    return os.access(made, os.W_OK | os.X_OK)


def _processor() -> str:
    """A digest of what the processor can do: machine code for a processor that can do more would crash here."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    features = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    return hashlib.sha256((features or platform.processor()).encode()).hexdigest()[:8]
