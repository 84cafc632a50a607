"""The libraries of an FMU: by the system's C compiler, and by `ziglang` for other platforms."""

from __future__ import annotations

import importlib.util
import platform
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory, gettempdir

from acausal.errors import ExportError, reason, shortened

MACHINES = {"AMD64": "x86_64", "x86_64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}
SYSTEMS = {"Linux": "linux", "Darwin": "darwin", "Windows": "windows"}
ENDINGS = {"linux": ".so", "darwin": ".dylib", "windows": ".dll"}
ZIG_TARGETS = {
    "x86_64-linux": "x86_64-linux-gnu.2.17",
    "aarch64-linux": "aarch64-linux-gnu.2.17",
    "x86_64-windows": "x86_64-windows-gnu",
    "aarch64-windows": "aarch64-windows-gnu",
    "x86_64-darwin": "x86_64-macos",
    "aarch64-darwin": "aarch64-macos",
}
"""By platform of FMI 3, what `ziglang` calls it. The Linux ones need glibc 2.17 of 2012."""
FMI2_FOLDERS = {
    "x86_64-linux": "linux64",
    "x86_64-windows": "win64",
    "x86_64-darwin": "darwin64",
    "aarch64-darwin": "darwin64",
}
PLATFORMS = tuple(ZIG_TARGETS)
"""Those that a library can be built for."""


@dataclass(frozen=True)
class Platform:
    """A platform in FMI's words.

    Attributes:
        name: FMI 3's. folder: under ``binaries``. ending: of a library.
    """

    name: str
    folder: str
    ending: str


def platform_named(name: str, fmi: str) -> Platform | None:
    """A platform by its name in FMI 3; None if this version of FMI has none for it."""
    folder = name if fmi == "3.0" else FMI2_FOLDERS.get(name)
    if name not in ZIG_TARGETS or folder is None:
        return None
    return Platform(name, folder, ENDINGS[name.split("-")[1]])


def this_platform(fmi: str) -> Platform | None:
    """The platform of this computer; None if FMI has no name for it."""
    system, machine = SYSTEMS.get(platform.system()), MACHINES.get(platform.machine())
    return platform_named(f"{machine}-{system}", fmi)


def compiler() -> str | None:
    """The system's C compiler, or None."""
    return next((c for name in ("cc", "gcc", "clang") if (c := shutil.which(name))), None)


def cross_compiler(platform: Platform) -> list[str] | None:
    """The command that compiles for another platform, by the package `ziglang`; None without it."""
    if importlib.util.find_spec("ziglang") is None:
        return None
    target = ZIG_TARGETS[platform.name]
    return [sys.executable, "-m", "ziglang", "cc", "-target", target, "-g0", "-s"]


def build(
    name: str, files: Mapping[str, str], sources: Sequence[str], command: Sequence[str]
) -> bytes:
    """The library, compiled.

    Arguments:
        name: of the model. files: texts of headers and sources by name. sources: those to compile.
        command: the compiler, and what it is always told.

    Raises:
        ExportError: with the first complaint of the compiler, or why its files cannot be written.
    """
    try:
        return _built(name, files, sources, command)
    except OSError as e:
        raise ExportError(
            f"export.fmu: the library cannot be compiled in '{gettempdir()}': {reason(e)}."
        ) from e


def _built(
    name: str, files: Mapping[str, str], sources: Sequence[str], command: Sequence[str]
) -> bytes:
    with TemporaryDirectory() as folder:
        for file, text in files.items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        flags = ["-std=c99", "-O2", "-fPIC", "-fvisibility=hidden", "-shared"]
        done = subprocess.run(
            [*command, *flags, "-o", name, *sources, "-lm"],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            first = next((x for x in done.stderr.splitlines() if "error" in x), done.stderr)
            raise ExportError(
                f"export.fmu: '{' '.join(command)}' failed ({shortened(first)}); "
                "mend it, or write a source FMU by binary=False."
            )
        return (Path(folder) / name).read_bytes()
