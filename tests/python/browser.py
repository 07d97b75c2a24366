"""A real browser for tests: Chromium without a window, driven over its DevTools protocol."""

from __future__ import annotations

import base64
import ctypes
import io
import json
import os
import signal
import subprocess
import sys
import time
import urllib.request
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

import saltus
from saltus.view.browser import chromium_command, find_chromium

WAIT = 60.0  # s until an answer counts as none; no assertion depends on it

POSE = 1e-6  # [m | 1] poses are stored as float32, and drawn so: 6e-8 of 1 m each


def end_with_parent() -> None:
    """Have the kernel end this process where the tests are killed: a browser goes on drawing."""
    death_signal = 1  # PR_SET_PDEATHSIG
    ctypes.CDLL(None).prctl(death_signal, signal.SIGKILL)


class Browser:
    """A running Chromium; `open` gives a tab."""

    def __init__(self, folder: Path) -> None:
        from websockets.sync.client import connect

        command = chromium_command(find_chromium(), folder)
        self.process = subprocess.Popen(
            [*command, "--remote-debugging-port=0", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            preexec_fn=end_with_parent if sys.platform == "linux" else None,
        )
        told = folder / "DevToolsActivePort"
        until(lambda: told.exists() and len(told.read_text().splitlines()) == 2)
        port, path = told.read_text().splitlines()
        self.connection = connect(f"ws://127.0.0.1:{port}{path}", max_size=None)
        self.socket = self.connection.__enter__()
        self.number = 0
        self.tabs: dict[str, Tab] = {}

    def ask(self, method: str, session: str | None = None, **parameters: Any) -> Any:
        """Call a method of the protocol and return its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        self.socket.send(json.dumps(message | ({"sessionId": session} if session else {})))
        own = self.number
        while True:
            answer = json.loads(self.socket.recv(timeout=WAIT))
            if answer.get("id") == own:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            if "method" in answer:
                self._note(answer)

    def _note(self, event: dict[str, Any]) -> None:
        tab = self.tabs.get(event.get("sessionId", ""))
        if tab is not None:
            tab.note(event["method"], event["params"])

    def open(
        self,
        url: str,
        size: tuple[int, int] = (1100, 700),
        *,
        dark: bool = False,
        ratio: float = 1,
        without: str = "",
    ) -> Tab:
        """Open a page in a tab of its own, and wait until it is there.

        `without` is JavaScript that takes something away from the browser before the page begins.
        """
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        tab = self.tabs[session] = Tab(self, session, target)
        for domain in ("Page", "Runtime", "Network", "Log"):
            tab.ask(f"{domain}.enable")
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        tab.ask("Emulation.setEmulatedMedia", features=[scheme])
        tab.resize(size, ratio)
        if without:
            tab.ask("Page.addScriptToEvaluateOnNewDocument", source=without)
        tab.ask("Page.navigate", url=url)
        until(lambda: tab.run("document.readyState") == "complete")
        return tab

    def close(self) -> None:
        try:
            self.ask("Browser.close")
        except Exception:
            self.process.kill()
        self.connection.__exit__(None, None, None)
        self.process.wait(WAIT)


class Tab:
    """A page in the browser: what it says, asks for and shows."""

    def __init__(self, browser: Browser, session: str, target: str) -> None:
        self.browser, self.session, self.target = browser, session, target
        self.problems: list[str] = []
        self.requests: list[str] = []

    def ask(self, method: str, **parameters: Any) -> Any:
        return self.browser.ask(method, self.session, **parameters)

    def note(self, method: str, event: dict[str, Any]) -> None:
        if method == "Runtime.exceptionThrown":
            self.problems.append(json.dumps(event["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and event["type"] in ("error", "warning"):
            self.problems.append(" ".join(str(a.get("value", a)) for a in event["args"]))
        elif method == "Log.entryAdded" and event["entry"]["level"] == "error":
            self.problems.append(event["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(event["request"]["url"][:200])

    def run(self, code: str) -> Any:
        """Return what an expression of JavaScript gives; promises are awaited."""
        answer = self.ask(
            "Runtime.evaluate", expression=code, awaitPromise=True, returnByValue=True
        )
        if "exceptionDetails" in answer:
            raise RuntimeError(json.dumps(answer["exceptionDetails"])[:2000])
        return answer["result"].get("value")

    def ready(self) -> Tab:
        """Wait until the page of a run is built."""
        until(lambda: self.run("typeof window.saltus") == "object")  # unpacked in its own time
        self.run("window.saltus.ready.then(() => 0)")
        return self

    def seek(self, time: float) -> None:
        """Go to a time of the run."""
        self.run(f"saltus.seek({float(time)!r})")

    def resize(self, size: tuple[int, int], ratio: float = 1) -> None:
        width, height = size
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=ratio, mobile=False,
        )  # fmt: skip

    def settle(self) -> None:
        """Wait until the page has drawn what changed."""
        frame = "new Promise((done) => requestAnimationFrame(() => done(0)))"
        self.run(f"{frame}.then(() => {frame})")

    def png(self) -> bytes:
        self.settle()
        return base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"])

    def picture(self) -> np.ndarray:
        """Return the pixels of the canvas alone, shape (height, width, 3), as whole numbers."""
        url = self.run("(saltus.page.render(), saltus.page.stage.canvas.toDataURL('image/png'))")
        return pixels(base64.b64decode(url.partition(",")[2]))

    def key(self, key: str, shift: bool = False) -> None:
        modifiers = 8 if shift else 0
        text = {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            more = text if kind == "keyDown" else {}
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, modifiers=modifiers, **more)

    def mouse(self, kind: str, x: float, y: float, buttons: int = 0, count: int = 1) -> None:
        self.ask(
            "Input.dispatchMouseEvent", type=kind, x=x, y=y, buttons=buttons,
            button="left" if kind != "mouseMoved" or buttons else "none", clickCount=count,
        )  # fmt: skip

    def click(self, selector: str) -> None:
        """Click the middle of an element as a mouse does."""
        x, y = self.run(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            "e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect();"
            "return [r.x + r.width / 2, r.y + r.height / 2]; })()"
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, buttons=1)

    def close(self) -> None:
        self.browser.ask("Target.closeTarget", targetId=self.target)
        del self.browser.tabs[self.session]


def pixels(png: bytes) -> np.ndarray:
    """Return the pixels of a PNG, shape (height, width, 3), as whole numbers."""
    from matplotlib.image import imread

    return np.round(255 * imread(io.BytesIO(png), format="png")[..., :3]).astype(int)


def until(condition, wait: float = WAIT) -> None:
    """Return when a condition holds; a test fails where that takes a minute."""
    end = time.monotonic() + wait
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError("waited in vain")
        time.sleep(0.02)


def fetch(url: str, data: bytes | None = None) -> bytes:
    with urllib.request.urlopen(urllib.request.Request(url, data), timeout=WAIT) as answer:
        return answer.read()


def children(pid: int) -> set[int]:
    """Return the processes that a process started and that live, on Linux."""
    tasks = Path(f"/proc/{pid}/task/{pid}/children")
    return {int(word) for word in tasks.read_text().split()} if tasks.exists() else set()


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def poses(tab: Tab) -> dict[str, np.ndarray]:
    return {name: np.array(pose) for name, pose in tab.run("saltus.poses()")}


def true_poses(run: saltus.Trajectory, q: np.ndarray) -> dict[str, np.ndarray]:
    """Return matrices of all shapes but half-spaces at a configuration."""
    shapes = [s for s in run.model.shapes if not isinstance(s.shape, saltus.HalfSpace)]
    return {s.name: run.model.shape_poses(q[np.newaxis], s.name)[0] for s in shapes}


def assert_poses(tab: Tab, run: saltus.Trajectory, q: np.ndarray) -> None:
    shown, true = poses(tab), true_poses(run, q)
    assert shown.keys() == true.keys()
    for name, X in true.items():
        np.testing.assert_allclose(shown[name][:3], X[:3, 3], atol=POSE, rtol=0)
        R = saltus.Pose.from_quaternion(shown[name][3:]).R
        np.testing.assert_allclose(R, X[:3, :3], atol=POSE, rtol=0)


def quiet(tab: Tab) -> None:
    """Assert that the page had no problem and asked for nothing but its file."""
    tab.run("0")
    assert tab.problems == []
    assert len(tab.requests) == 1
    assert tab.requests[0].startswith("file://")


def started_with(variable: str) -> set[int]:
    """Return the processes, on Linux, that have a variable in their environment; not zombies."""

    def has(process: Path) -> bool:
        with suppress(OSError):  # ended, or another's
            return variable.encode() in (process / "environ").read_bytes()  # empty for zombies
        return False

    return {int(p.name) for p in Path("/proc").glob("[0-9]*") if has(p)} - {os.getpid()}
