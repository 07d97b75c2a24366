"""A model that is simulated while its page is open."""

from __future__ import annotations

import base64
import json
import threading
import time
from collections.abc import Callable
from io import BufferedIOBase
from typing import Any

import numpy as np

from saltus._core import Model, ModelError, State, StepError, Stepper
from saltus.view.events import Events
from saltus.view.frames import Frame
from saltus.view.page import LIVE_POLICY, page_of
from saltus.view.parts import Parts
from saltus.view.pull import Pull, force_of
from saltus.view.scene import scene_of_model
from saltus.view.server import PageServer
from saltus.view.sliders import controls_of, posture, sliders_of

FRAME = 1 / 60  # s between frames
BREATH = 0.002  # s between frames at least, in which others get the lock
QUIET = 0.5  # s without news, after which a stream shows that it lives
GRACE = 2.0  # s without a page until the server ends: a page may be loaded anew
MOST_LATE = (
    0.1  # s on the wall that are made up for; what a slow model is later than that is dropped
)
SPEEDS = (0.001, 10.0)


class Live:
    """A model, its state, and what the page may do to it.

    Attributes
    ----------
    state : State
    playing : bool
    """

    def __init__(self, model: Model, state: State, *, h: float) -> None:
        self.model, self.start, self.state, self.h = model, state, state, h
        self.stepper = Stepper(model, h)
        self.parts = Parts(model, np.asarray(state.q))
        self.scene = scene_of_model(model, self.parts, state, h)
        self.sliders = sliders_of(model, reach=max(1.0, _size(self.parts, state)))
        self.scene["sliders"] = [
            {"name": s.name, "unit": s.unit, "lower": s.lower, "upper": s.upper}
            for s in self.sliders
        ]
        self.scene["controls"] = controls_of(model)
        self.events = Events(model, np.asarray(state.q), h, self.parts.origin)
        self.scene["gaps"]["pairs"] = self.events.pairs
        self.playing = True
        self.speed = 1.0
        self.pull: Pull | None = None
        self.pulled = ""  # name of its link
        self.control = np.zeros(model.n_u)
        self.problem = ""
        self.lock = threading.Lock()
        self.asking = threading.Event()
        self.news = threading.Condition()
        self.frame = Frame()
        self.pages = 0
        self.last_page = -1.0  # when the last page went; -1: none came yet
        self.actions: dict[str, Callable[[dict[str, Any]], None]] = {
            "play": lambda _: self._play(True),
            "pause": lambda _: self._play(False),
            "step": lambda _: self._single(),
            "reset": lambda _: self._reset(),
            "speed": self._set_speed,
            "set": self._set,
            "control": self._control,
            "pull": self._pull,
            "release": lambda _: self._release(),
            "gap": lambda asked: self.events.choose(_number(asked, "pair", len(self.events.pairs))),
        }

    def page(self) -> str:
        """Return the page of the model as it is now."""
        return page_of(self.scene, policy=LIVE_POLICY)

    def do(self, body: bytes) -> str:
        """Do what the page asks for; raise ModelError with words for it where that cannot be."""
        try:
            asked = json.loads(body)
            action = self.actions[asked["do"]]
        except (ValueError, KeyError, TypeError):
            raise ModelError(
                f"the page asked for {body[:80]!r}; there are {', '.join(self.actions)}"
            ) from None
        self.asking.set()  # the steps let wishes go first, however late they are
        with self.lock:
            self.asking.clear()
            try:
                action(asked)
            except (KeyError, TypeError, IndexError) as error:
                raise ModelError(f"{asked['do']}: {error!r} in what the page asked for") from None
        self.tell()
        return ""

    def run(self, until: Callable[[], bool]) -> None:
        """Simulate by the clock on the wall, a frame every sixtieth of a second."""
        last = time.monotonic()
        owed = 0.0
        while not until():
            now = time.monotonic()
            with self.lock:
                if self.playing:
                    most = max(MOST_LATE * self.speed, self.h)  # a long step is owed whole
                    owed = min(owed + (now - last) * self.speed, most)
                    owed -= self._steps(owed)
                    moved = True
                else:
                    owed, moved = 0.0, False
            last = now
            if moved:
                self.tell()
            time.sleep(max(BREATH, FRAME - (time.monotonic() - now)))

    def tell(self) -> None:
        """Give all pages the state as it is."""
        with self.lock:
            text = self._frame()
            with self.news:  # within: an older frame must not come after a newer one
                number, events = self.frame.number + 1, self.events
                self.frame = Frame(number, text, events.beginning, events.impacts)
                self.news.notify_all()

    def stream(self, out: BufferedIOBase) -> None:
        """Write frames to a page until it is closed.

        A slow page misses frames, not impacts: each page is told those that it does not know.
        """
        with self.news:
            self.pages += 1
        try:
            seen = Frame()
            while True:
                with self.news:
                    if self.frame.number == seen.number:
                        self.news.wait(QUIET)
                    frame = self.frame
                is_new = frame.number != seen.number
                out.write(b"data: " + frame.since(seen) + b"\n\n" if is_new else b":\n\n")
                out.flush()
                seen = frame
        except OSError:
            pass  # the page is closed
        finally:
            with self.news:
                self.pages -= 1
                self.last_page = time.monotonic()

    def is_left(self) -> bool:
        """Whether the last page was closed some time ago."""
        with self.news:
            gone = self.pages == 0 and self.last_page >= 0
            return gone and time.monotonic() > self.last_page + GRACE

    def _steps(self, owed: float) -> float:
        """Step as long as a step is owed and a frame's time is left; return the time made."""
        end = time.monotonic() + FRAME
        made = 0.0
        while owed - made >= self.h and self.playing:
            self._advance()
            made += self.h
            if time.monotonic() > end or self.asking.is_set():
                break
        return made

    def _advance(self) -> None:
        try:
            forces = None
            if self.pull is not None:
                forces = {self.pulled: force_of(self.model, self.state, self.pull)}
            self.state = self.stepper.advance(self.state, control=self.control, forces=forces)
        except (StepError, ModelError) as error:
            self.playing = False
            self.problem = f"stopped: {error}"
            return
        self.events.add(self.stepper.report)

    def _frame(self) -> str:
        q = np.asarray(self.state.q)
        poses = np.ascontiguousarray(self.parts.poses(q[np.newaxis])[0], "<f4")
        return json.dumps(
            {
                "t": self.state.t,
                "poses": base64.b64encode(poses.tobytes()).decode(),
                "kinetic": self.model.kinetic_energy(self.state),
                "potential": self.model.potential_energy(q),
                "playing": self.playing,
                "speed": self.speed,
                "values": [slider.get(q) for slider in self.sliders],
                "control": self.control.tolist(),
                **self.events.told(q),
                "problem": self.problem,
                "sent": time.time(),
            }
        )

    def _play(self, playing: bool) -> None:
        self.playing = playing
        self.problem = ""

    def _single(self) -> None:
        self._play(False)
        self._advance()

    def _reset(self) -> None:
        self.state, self.pull, self.problem = self.start, None, ""
        self.events.forget()
        self.control[:] = 0

    def _set_speed(self, asked: dict[str, Any]) -> None:
        value = float(asked["value"])
        if not np.isfinite(value):
            raise ModelError(f"speed = {value:g}; it is a number")
        self.speed = float(np.clip(value, *SPEEDS))

    def _set(self, asked: dict[str, Any]) -> None:
        slider = self.sliders[_number(asked, "slider", len(self.sliders))]
        state = posture(self.model, self.state, slider, float(asked["value"]))
        Stepper(self.model, self.h).advance(state)  # refuses a posture in which bodies overlap
        self.state, self.problem = state, ""
        self.events.forces = []

    def _control(self, asked: dict[str, Any]) -> None:
        value = float(asked["value"])
        if not np.isfinite(value):
            raise ModelError(f"control = {value:g}; it is a number")
        self.control[_number(asked, "actuator", len(self.control))] = value

    def _pull(self, asked: dict[str, Any]) -> None:
        link = self.parts.bodies[_number(asked, "body", len(self.parts.bodies))]
        at, to = (np.array(asked[name], float) for name in ("at", "to"))
        if at.shape != (3,) or to.shape != (3,) or not np.isfinite([at, to]).all():
            raise ModelError("pull: two points of three numbers are to be given")
        self.pull, self.pulled = Pull(link, at, to + self.parts.origin), self.model.links[link].name

    def _release(self) -> None:
        self.pull = None


def serve(model: Model, state: State, *, h: float, opened: Callable[[str], None] = print) -> None:
    """Simulate a model for pages in the browser, until the last of them is closed.

    Parameters
    ----------
    model : Model
    state : State
        At the start, and after a reset.
    h : float
        [s] time step.
    opened : callable
        Is given the address of the page.

    Raises
    ------
    ModelError
        On a start that does not fit the model.
    """
    live = Live(model, state, h=h)
    with PageServer(live.page, {"do": live.do}, {"events": live.stream}) as server:
        live.tell()
        opened(server.url)
        live.run(live.is_left)


def _number(asked: dict[str, Any], name: str, count: int) -> int:
    """Return the number of a thing that the page named; raise ModelError where there is none."""
    number = asked[name]
    if not (isinstance(number, int) and 0 <= number < count):
        raise ModelError(f"{asked['do']}: no {name} {number!r}; there are {count}")
    return number


def _size(parts: Parts, state: State) -> float:
    """Return how far bodies are from the origin [m]."""
    at = parts.origin + parts.poses(np.asarray(state.q)[np.newaxis])[0, :, :3]
    return float(np.linalg.norm(at, axis=1).max(initial=0.0))
