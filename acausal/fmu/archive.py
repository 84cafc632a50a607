"""Archives of FMUs: unpacked into a folder of their own, and nothing is written outside of it.

An archive may come from anybody: paths that climb, links, and contents that grow without end are refused.
"""

from __future__ import annotations

import platform
import shutil
import struct
import sys
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path, PurePosixPath
from typing import NoReturn
from weakref import WeakValueDictionary, finalize

from acausal.errors import DeclarationError, reason, shortened
from acausal.files import need_path

DESCRIPTION = "modelDescription.xml"

LARGEST = 2**30
"""Bytes: an archive that unpacks to more is refused."""

LARGEST_DESCRIPTION = 2**28
"""Bytes of the description."""

MOST = 100_000
"""Files in an archive."""

GROWTH = 250
"""So many times larger than it is packed may a file of `SMALL` bytes or more be: deflate packs text 10 to 50 times."""

SMALL = 2**24
CHUNK = 2**20


class Folder:
    """A folder that is removed when nothing refers to it any more, or Python ends."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="acausal-fmu-"))
        finalize(self, shutil.rmtree, self.path, ignore_errors=True)


def read(path: object) -> tuple[str, Folder]:
    """Unpack an FMU.

    Returns:
        The archive's digest, and the folder that holds its description, its binaries and its resources.

    Raises:
        DeclarationError: for what is not a sound archive.
    """
    file = need_path(path, "FMU", DeclarationError)
    try:
        with file.open("rb") as stream:
            digest = sha256()
            while part := stream.read(CHUNK):
                digest.update(part)
            name = digest.hexdigest()
            folder = _FOLDERS.get(name)
            if folder is None:
                folder = _FOLDERS[name] = _unpacked(file, stream)
        return name, folder
    except OSError as error:
        raise DeclarationError(f"FMU: '{file}' cannot be read: {reason(error)}.") from None


_FOLDERS: WeakValueDictionary[str, Folder] = WeakValueDictionary()
"""Where archives have been unpacked, by digest."""


def _unpacked(file: Path, stream: object) -> Folder:
    folder = Folder()
    try:
        with zipfile.ZipFile(stream) as archive:  # pyright: ignore[reportArgumentType, reportCallIssue]
            members = list(_members(file, archive))
            for member, target in members:
                _write(file, archive, member, folder.path / target)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError) as error:
        _refuse(file, f"is not a sound archive ({shortened(error)}); export it again")
    except (ValueError, RuntimeError) as error:  # encrypted, or a header that makes no sense
        _refuse(file, f"cannot be unpacked ({shortened(error)})")
    return folder


def _members(file: Path, archive: zipfile.ZipFile) -> Iterator[tuple[zipfile.ZipInfo, str]]:
    """The files that are needed, and where they go; the whole archive is checked."""
    listed = archive.infolist()
    if len(listed) > MOST:
        _refuse(file, f"holds {len(listed)} files; at most {MOST} are unpacked")
    total, names = 0, set[str]()
    for member in listed:
        name = member.filename.replace("\\", "/")
        path = PurePosixPath(name)
        if path.is_absolute() or ".." in path.parts or ":" in name or "\0" in member.orig_filename:
            _refuse(file, f"holds '{shortened(name)}', a path that leads out of it")
        if (member.external_attr >> 28) == 0xA:
            _refuse(file, f"holds '{shortened(name)}', a link; FMUs hold files only")
        if member.is_dir() or not _is_needed(name):
            continue
        if str(path) in names:
            _refuse(file, f"holds '{shortened(name)}' twice")
        names.add(str(path))
        total += member.file_size
        grows = member.file_size > GROWTH * max(member.compress_size, 1)
        if total > LARGEST or (grows and member.file_size >= SMALL):
            _refuse(file, f"unpacks to {total / 2**20:.0f} MB or more; so much is not unpacked")
        yield member, str(path)
    if DESCRIPTION not in names:
        _refuse(file, f"has no {DESCRIPTION}: it is not an FMU")
    if archive.getinfo(DESCRIPTION).file_size > LARGEST_DESCRIPTION:
        _refuse(file, f"has a {DESCRIPTION} of more than {LARGEST_DESCRIPTION >> 20} MB")


def _is_needed(name: str) -> bool:
    folders = ("resources/", *(f"binaries/{p}/" for p in PLATFORMS))
    return name == DESCRIPTION or name.startswith(folders)


def _write(file: Path, archive: zipfile.ZipFile, member: zipfile.ZipInfo, target: Path) -> None:
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        left = member.file_size
        with archive.open(member) as source, target.open("xb") as sink:
            while part := source.read(CHUNK):
                left -= len(part)
                if left < 0:
                    _refuse(file, f"holds '{member.filename}', which is larger than it says")
                sink.write(part)
    except (FileExistsError, NotADirectoryError, IsADirectoryError):
        _refuse(file, f"holds '{shortened(member.filename)}' as a file and as a folder")


def _refuse(file: Path, why: str) -> NoReturn:
    raise DeclarationError(f"FMU: '{file}' {why}.") from None


def _platforms() -> tuple[str, ...]:
    """This platform's name in FMI 3 and in FMI 2."""
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, "linux")
    machine = platform.machine().lower()
    machine = {"amd64": "x86_64", "arm64": "aarch64"}.get(machine, machine)
    short = {"windows": "win"}.get(system, system)
    older = {"x86_64": (f"{short}64",), "aarch64": (f"{short}64",) if short == "darwin" else ()}
    return f"{machine}-{system}", *older.get(machine, ())


PLATFORMS = _platforms()
ENDING = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")


def binary(folder: Path, identifier: str, name: object) -> Path:
    """The library of an unpacked FMU for this platform.

    Raises:
        DeclarationError: where there is none, with those that there are.
    """
    if "/" in identifier or "\\" in identifier or identifier.startswith("."):
        raise DeclarationError(
            f"FMU: '{name}': '{shortened(identifier)}' is not a name of a library."
        )
    for place in PLATFORMS:
        if (found := folder / "binaries" / place / f"{identifier}{ENDING}").is_file():
            if _is_cut_off(found.read_bytes()):
                raise DeclarationError(
                    f"FMU: the binary of '{name}' is cut off or no library; export it again."
                )
            return found
    raise DeclarationError(
        f"FMU: '{name}' has no binary for this platform (binaries/{PLATFORMS[-1]}/{identifier}{ENDING}); "
        "export it for this platform, or compile its sources into it: fmpy compile."
    )


def _is_cut_off(content: bytes) -> bool:
    """Whether a library of Linux ends before its segments do: the system's loader would end the process."""
    if ENDING != ".so":
        return False
    try:
        start, size, count = (
            *struct.unpack_from("<Q", content, 32), *struct.unpack_from("<HH", content, 54),
        )  # fmt: skip
        ends = [
            sum(struct.unpack_from("<Q16xQ", content, start + i * size + 8)) for i in range(count)
        ]
    except struct.error:
        return True
    return not content.startswith(b"\x7fELF") or max(ends, default=0) > len(content)
