"""Videos of runs, made by the page itself in a Chromium without a window."""

from __future__ import annotations

import math
import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from saltus._core import ModelError
from saltus.records.recording import Recording
from saltus.records.replace import check_target, replacing
from saltus.view.browser import chromium_command, find_chromium
from saltus.view.page import LIVE_POLICY, page_of
from saltus.view.scene import scene_of_run
from saltus.view.server import PageServer

if TYPE_CHECKING:
    import subprocess

VIEWS = ("corner", "front", "side", "top")
MOST_FRAMES = 200_000
MOST_PIXELS = 4096
SILENCE = 120.0  # s without a new frame: something is wrong


def video(
    run: Recording,
    path: str | os.PathLike[str],
    *,
    rate: float = 30.0,
    slow: float = 1.0,
    size: tuple[int, int] = (1280, 720),
    view: str = "corner",
    follow: str | None = None,
    dark: bool = False,
) -> None:
    """Write a video of a run; see `Trajectory.video`."""
    path = Path(path)
    job = _job(run, path, rate, slow, size, view, dark)
    program = find_chromium()
    scene = scene_of_run(run)
    job["follow"] = None if follow is None else _body(scene, follow)
    scene["job"] = job
    office = _Office()
    posts = {"video": office.take, "problem": office.complain, "progress": office.hear}
    text = page_of(scene, policy=LIVE_POLICY)
    with PageServer(lambda: text, posts) as server, _running(program, server.url) as process:
        data = office.wait(process)
    with replacing(path) as part:
        part.write_bytes(data)


def check_video(path: Path, rate: float, slow: float) -> None:
    """Raise ModelError on a file or numbers that no video can have."""
    check_target(path)
    if path.suffix.lower() != ".webm":
        raise ModelError(f"{path}: videos are WebM files; their names end with .webm")
    for name, value in (("rate", rate), ("slow", slow)):
        if not (math.isfinite(value) and value > 0):
            raise ModelError(f"{name} = {value:g}; it is a number above 0")


def _job(
    run: Recording,
    path: Path,
    rate: float,
    slow: float,
    size: tuple[int, int],
    view: str,
    dark: bool,
) -> dict[str, Any]:
    """Return what the page is asked for; raise ModelError on what no video can have."""
    check_video(path, rate, slow)
    width, height = size
    if not (16 <= width <= MOST_PIXELS and 16 <= height <= MOST_PIXELS):
        raise ModelError(f"size = {width} x {height}; both are from 16 to {MOST_PIXELS} pixels")
    if view not in VIEWS:
        raise ModelError(f'no view "{view}"; views are {", ".join(VIEWS)}')
    frames = math.floor((run.t[-1] - run.t[0]) * rate * slow + 1e-6) + 1
    if frames > MOST_FRAMES:
        raise ModelError(
            f"{frames} frames, more than {MOST_FRAMES}; take a smaller rate or a smaller slow"
        )
    theme = "dark" if dark else "light"
    shown = {"width": int(width), "height": int(height), "view": view, "theme": theme}
    return {"url": ".", "rate": rate, "slow": slow, **shown}


def _body(scene: dict[str, Any], link: str) -> int:
    for frame in scene["frames"]:
        if frame["name"] == link and frame["body"] >= 0:
            return int(frame["body"])
    moving = ", ".join(frame["name"] for frame in scene["frames"] if frame["body"] >= 0)
    raise ModelError(f'no moving link "{link}" to follow; there are {moving or "none"}')


class _Office:
    """Takes what the page sends, and waits for it."""

    def __init__(self) -> None:
        self.data = b""
        self.problem = ""
        self.heard = time.monotonic()
        self.done = threading.Event()

    def take(self, body: bytes) -> str:
        self.data = body
        self.done.set()
        return ""

    def complain(self, body: bytes) -> str:
        self.problem = body.decode(errors="replace")
        self.done.set()
        return ""

    def hear(self, _: bytes) -> str:
        self.heard = time.monotonic()
        return ""

    def wait(self, process: subprocess.Popen[bytes]) -> bytes:
        """Return the video; raise ModelError where none comes."""
        self.heard = time.monotonic()
        while not self.done.wait(0.1):
            if process.poll() is not None:
                raise ModelError(f"Chromium ended with code {process.returncode} before the video")
            if time.monotonic() > self.heard + SILENCE:
                raise ModelError(f"Chromium made no frame of the video for {SILENCE:g} s")
        if self.problem:
            raise ModelError(f"Chromium made no video: {self.problem}")
        return self.data


@contextmanager
def _running(program: str, url: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run a Chromium with a page; nothing of it is left after."""
    import subprocess
    import tempfile

    with tempfile.TemporaryDirectory(prefix="saltus-", ignore_cleanup_errors=True) as folder:
        process = subprocess.Popen(
            [*chromium_command(program, folder), url],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # so that its own processes can be ended with it
        )
        try:
            yield process
        finally:
            _end(process)


def _end(process: subprocess.Popen[bytes]) -> None:
    import signal
    import subprocess

    for how in (signal.SIGTERM, signal.SIGKILL):
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, how)
        with suppress(subprocess.TimeoutExpired):
            process.wait(5)
