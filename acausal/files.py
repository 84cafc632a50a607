"""Files: paths that users give, checked; files written completely or not at all, by one process.

A regular file that exists is replaced, without a question, by whatever writes.
"""

from __future__ import annotations

import csv
import errno
import glob
import io
import json
import logging
import math
import os
import platform
import secrets
import stat
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any, TextIO, cast

from acausal.errors import AcausalError, DataError, reason, shown

try:
    import fcntl
except ImportError:  # on Windows
    fcntl = None

LOGGER = logging.getLogger(__name__)

LONG = 200
"""Bytes of a name; the hidden files beside a file with a longer one are called by its digest. Systems allow 255."""


def need_path(given: object, function: str, error: type[AcausalError] = DataError) -> Path:
    """A path as such, ``~/`` being the user's folder; anything that is none is refused.

    Raises:
        AcausalError: of the class ``error``.
    """
    if not isinstance(given, str | os.PathLike):
        raise error(
            f"{function}: {shown(given)} is not a path; give a text such as 'folder/file', or a pathlib.Path."
        )
    text = os.fsdecode(given)
    if flaw := _flaw(text):
        raise error(f"{function}: {shown(text)} is not a path; it {flaw}.")
    return Path(text).expanduser() if text.startswith("~/") else Path(text)


def need_paths(given: object, function: str, error: type[AcausalError] = DataError) -> list[Path]:
    """Several paths as such; anything else, such as one path, is refused.

    Raises:
        AcausalError: of the class ``error``.
    """
    if not isinstance(given, list | tuple):
        raise error(f"{function}: path={shown(given)} are not folders; give a list of paths.")
    return [need_path(path, function, error) for path in cast("Sequence[object]", given)]


def file_to_write(given: object, function: str, *, need_folder: bool = True) -> Path:
    """The path of a file that is to be written, checked before what it shall hold is computed.

    Arguments:
        given: what the user gave. function: that was called with it, for the message.
        need_folder: whether its folder must exist.

    Raises:
        DataError: for what is no path, a folder, or a file in a folder that does not exist.
    """
    path = need_path(given, function)
    if path.is_dir():
        raise DataError(f"{function}: '{path}' is a folder; give the path of a file.")
    if need_folder and not path.parent.is_dir():
        raise DataError(f"{function}: there is no folder '{path.parent}'; make it first.")
    return path


def write_files(
    contents: Mapping[Path, str | bytes],
    error: type[AcausalError] = DataError,
    *,
    make_folders: bool = False,
) -> None:
    """Write files, each as `replace_file` does, and none if one of them cannot be written.

    Arguments:
        contents: texts or bytes by path. Texts are written in UTF-8; halves of surrogate pairs, which it does not
            have, as JSON and Python escape them.
        error: the class of errors.
        make_folders: whether folders are made.

    Raises:
        AcausalError: of the class ``error``, with the operating system's reason.
    """
    path = Path()
    with ExitStack() as stack:
        try:
            moves: list[Callable[[], object]] = []
            for path, content in contents.items():
                if make_folders:
                    _make_folder(path.parent)
                text = isinstance(content, str)
                data = content.encode(errors="backslashreplace") if text else content
                moves.append(stack.enter_context(_written(path, data)))
            for path, move in zip(contents, moves, strict=True):
                move()
                LOGGER.info("wrote %s", path)
        except OSError as failed:
            raise error(f"'{path}' cannot be written: {reason(failed)}.") from failed


def replace_file(path: Path, content: bytes) -> None:
    """Write a file: a reader sees the old one or the new one, whatever happens.

    A link stays a link, and the mode of the file is kept. A device or pipe, such as ``/dev/stdout``, is written to.

    Raises:
        OSError: if it cannot be written; the old one is still there.
    """
    with _written(path, content) as move:
        move()


class Lock:
    """The right of one process to write a file, until it ends or is killed.

    It is a lock of the operating system on a hidden file beside the other one. Where there is none, on Windows and some
    network file systems, nothing is locked.

    Arguments:
        path: the file.
    """

    def __init__(self, path: Path) -> None:
        file = Path(os.path.realpath(path))
        self._path = _beside(file, "lock")
        self._parts = glob.escape(_beside(file, "").name) + "?" * 8 + ".part"
        self._held: TextIO | None = None

    def hold(self) -> None:
        """Lock the file, also where the lock was removed meanwhile; remove what killed processes left of it.

        Raises:
            BlockingIOError: if another process has locked it; the reason names that.
            OSError: if a file cannot be made beside it.
        """
        while fcntl is not None and not self._is_held():
            self.close()
            self._held = self._path.open("a+", encoding="utf-8")
            try:
                fcntl.flock(self._held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self._held.seek(0)
                holder = self._held.read() or "another process"
                self._held.close()
                self._held = None
                raise BlockingIOError(
                    errno.EWOULDBLOCK,
                    f"{holder} is writing it; wait until that ends, or name another file",
                ) from None
            except OSError:  # the file system has no locks
                pass
            self._held.truncate(0)
            self._held.write(f"process {os.getpid()} on {platform.node()}")
            self._held.flush()
            for part in self._path.parent.glob(self._parts):
                part.unlink(missing_ok=True)

    def close(self) -> None:
        """Unlock the file."""
        if self._held is not None:
            if self._is_held():
                self._path.unlink(missing_ok=True)
            self._held.close()
            self._held = None

    def _is_held(self) -> bool:
        """Whether the locked file is still the one that others find."""
        if self._held is None:
            return False
        try:
            return os.path.samestat(os.fstat(self._held.fileno()), self._path.stat())
        except OSError:
            return False


@contextmanager
def _written(path: Path, content: bytes) -> Generator[Callable[[], object]]:
    """Write beside a file; what this yields moves it there.

    Raises:
        OSError: if it cannot be written.
    """
    file, mode = Path(os.path.realpath(path)), _mode(path)
    if stat.S_ISCHR(mode) or stat.S_ISFIFO(mode):
        yield partial(path.write_bytes, content)
        return
    part = _beside(file, f"{secrets.token_hex(4)}.part")

    def move() -> None:
        part.replace(file)
        with suppress(OSError):  # some file systems cannot make a rename durable
            _sync(file.parent)

    try:
        with part.open("xb") as stream:
            if mode:
                with suppress(OSError):  # some file systems have no modes
                    part.chmod(stat.S_IMODE(mode))
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        yield move
    finally:
        with suppress(OSError):  # where it was moved, it is not there
            part.unlink()


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:  # as a file
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR)) from None


def _mode(path: Path) -> int:
    """Kind and permissions of what is at a path, 0 if there is nothing.

    Raises:
        OSError: for what cannot be written to.
    """
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return 0
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not (stat.S_ISREG(mode) or stat.S_ISCHR(mode) or stat.S_ISFIFO(mode)):
        raise OSError(errno.EINVAL, "It is not a file")
    if not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return mode


def _beside(file: Path, ending: str) -> Path:
    """A hidden file beside another one."""
    name = os.fsencode(file.name)
    return file.with_name(
        f".{file.name if len(name) <= LONG else sha256(name).hexdigest()}.{ending}"
    )


def _flaw(text: str) -> str:
    """Why a text is no path; nothing where it is one."""
    if not text:
        return "is empty"
    if "\0" in text:
        return "has a null character"
    try:
        os.lstat(text)
    except UnicodeEncodeError:
        return "has a character that no file name can have"
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:
            return "is too long"
    return ""


def _sync(folder: Path) -> None:
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def json_text(content: object, indent: int | None = None) -> str:
    """JSON, in which numbers that are not finite are null."""
    return json.dumps(finite(content), indent=indent, ensure_ascii=False, allow_nan=False) + "\n"


def finite(value: Any) -> Any:
    """The same with None for numbers that JSON does not know."""
    if isinstance(value, Mapping):
        return {str(name): finite(inner) for name, inner in value.items()}
    if isinstance(value, list | tuple):
        return [finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def csv_text(columns: Mapping[str, Any]) -> str:
    """Arrays of one length by header, as text that spreadsheets read."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(columns)
    writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))
    return text.getvalue()
