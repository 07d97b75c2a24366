"""Finding a Chromium on this machine, for videos."""

from __future__ import annotations

import os
from pathlib import Path

from saltus._core import ModelError

NAMES = (
    "chromium",
    "chromium-browser",
    "google-chrome-stable",
    "google-chrome",
    "chrome",
    "microsoft-edge",
    "brave-browser",
)
MAC = (
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
)
VARIABLE = "SALTUS_CHROMIUM"


def find_chromium() -> str:
    """Return the path of a Chromium or of a browser that is built on it.

    Returns
    -------
    str
        What the variable SALTUS_CHROMIUM names, else the first that is found.

    Raises
    ------
    ModelError
        Where there is none, with how to install one.
    """
    import shutil

    named = os.environ.get(VARIABLE)
    if named:
        found = shutil.which(named)
        if found is None:
            raise ModelError(f"{VARIABLE}={named}: there is no such program")
        return found
    for name in (*NAMES, *MAC):
        found = shutil.which(name)
        if found is not None:
            return found
    raise ModelError(
        "videos are made by Chromium, and none was found (looked for "
        f"{', '.join(NAMES)}); install it (apt-get install chromium), or name one in {VARIABLE}"
    )


def chromium_command(program: str, folder: str | os.PathLike[str]) -> list[str]:
    """Return the command of a Chromium without a window that keeps everything in a folder."""
    command = [
        program,
        "--headless=new",
        f"--user-data-dir={Path(folder)}",
        "--use-angle=swiftshader",  # draws without a graphics card, the same everywhere
        "--enable-unsafe-swiftshader",
        "--ignore-gpu-blocklist",
        "--disable-dev-shm-usage",
        "--disable-background-networking",
        "--disable-background-timer-throttling",
        "--disable-extensions",
        "--hide-scrollbars",
        "--mute-audio",
        "--no-first-run",
        "--no-default-browser-check",
    ]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        command.append("--no-sandbox")  # Chromium has none for root
    return command
