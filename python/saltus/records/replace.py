"""Files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterator
from pathlib import Path

from saltus._core import ModelError


def check_folder(path: str | os.PathLike[str]) -> None:
    """Raise ModelError where no file can be written."""
    path = Path(path)
    if path.is_dir():
        raise ModelError(f"{path} is a folder; a file is to be written")
    if not path.absolute().parent.is_dir():
        raise ModelError(f"{path}: there is no folder {path.parent}")


def check_target(path: str | os.PathLike[str]) -> None:
    """Raise ModelError as `check_folder`, and where what is there is no regular file."""
    check_folder(path)
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        raise ModelError(f"{path} is a link to {target}: there is no folder {target.parent}")
    if target.exists() and not target.is_file():
        raise ModelError(f"{path} is no regular file (a pipe or a device); it is left as it is")


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give the path of an empty file, which takes the place of `path` where nothing is raised.

    Until then the old file stays whole, and so it does where the machine stops. The new one has its
    permissions; where `path` is a link, what it points to is replaced.
    """
    check_target(path)
    target = Path(os.path.realpath(path))
    # A name of its own: two that save to one path do not write into one file.
    part = target.with_name(f".saltus-{os.urandom(8).hex()}.part")
    os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    try:
        yield part
        _sync(part)
        with contextlib.suppress(FileNotFoundError):
            _take_over(target.stat(), part)
        os.replace(part, target)
        with contextlib.suppress(OSError):  # not all systems open folders
            _sync(target.parent)
    finally:
        part.unlink(missing_ok=True)


def _sync(path: Path) -> None:
    """Have the machine write it to its disk: a name must not be there before its content."""
    file = os.open(path, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def _take_over(old: os.stat_result, part: Path) -> None:
    with contextlib.suppress(OSError):  # who may not give files away keeps them
        os.chown(part, old.st_uid, old.st_gid)
    os.chmod(part, stat.S_IMODE(old.st_mode))
