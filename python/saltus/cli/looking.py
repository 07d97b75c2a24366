"""The command `view`: a model or a recorded run in a browser."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import saltus
from saltus.cli.commands import INTERRUPTED, first_state, keep, load
from saltus.records.replace import check_target
from saltus.view import serve
from saltus.view.browser import find_chromium
from saltus.view.video import check_video

DURATION, STEP, LIVE_STEP = 10.0, 0.01, 1 / 120  # s; live two steps are a frame
MOVED = 1e-6  # [rad | m] less is rest
NUDGES = (0.3, -0.3)  # [rad | m] what a joint at rest is started with, as far as its limits allow


def view(chosen: argparse.Namespace) -> int:
    """Show a model or a run: in a browser, as a file, as a video, or live."""
    _check_outputs(chosen)  # before a long run, not after it
    recorded = _is_recorded(Path(chosen.file))
    if recorded:
        _refuse_options(chosen)
    if chosen.live:
        return _live(chosen)
    try:
        run = saltus.load(chosen.file) if recorded else _simulated(chosen)
    except saltus.StepError as error:
        if error.trajectory is not None:
            _give(chosen, error.trajectory)
        raise
    print(run.summary())
    _give(chosen, run)
    return 0 if run.complete or recorded else INTERRUPTED


def _live(chosen: argparse.Namespace) -> int:
    """Simulate for the page in the browser, until it is closed."""
    for name in ("html", "video"):
        if getattr(chosen, name):
            raise saltus.ModelError(f"--{name} writes a recorded run; it cannot go with --live")
    model = load(chosen, visuals=True)
    q = _start(model) | dict(chosen.q)
    state = first_state(model, q, dict(chosen.v))

    def opened(url: str) -> None:
        import webbrowser

        print(f"page: {url}", flush=True)
        if not chosen.no_browser and not webbrowser.open(url):
            print("no browser was found: open the page by hand; Ctrl-C ends it", flush=True)

    serve(model, state, h=LIVE_STEP if chosen.h is None else chosen.h, opened=opened)
    return 0


def _give(chosen: argparse.Namespace, run: saltus.Trajectory) -> None:
    if chosen.html:
        run.html(chosen.html, autoplay=True)
        print(f"page: {chosen.html}")
    if chosen.video:
        run.video(chosen.video, rate=chosen.rate, slow=chosen.slow)
        print(f"video: {chosen.video}")
    if not (chosen.html or chosen.video):
        run.show()


def _check_outputs(chosen: argparse.Namespace) -> None:
    keep(chosen.file, (chosen.html, chosen.video))
    if chosen.html is not None:
        check_target(chosen.html)
    if chosen.video is not None:
        check_video(Path(chosen.video), chosen.rate, chosen.slow)
        find_chromium()


def _is_recorded(path: Path) -> bool:
    """Whether a file begins as HDF5 files do."""
    if not path.is_file():
        if path.suffix in (".h5", ".hdf5"):
            raise saltus.ModelError(f"{path}: there is no such file")
        return False  # load_urdf says what is wrong
    with path.open("rb") as file:
        return file.read(8) == b"\x89HDF\r\n\x1a\n"


def _refuse_options(chosen: argparse.Namespace) -> None:
    given = {
        "--set": chosen.q,
        "--set-velocity": chosen.v,
        "--live": chosen.live,
        "--floating": chosen.floating,
        "--floor": chosen.floor,
        "--contact": chosen.contact is not None,
        "--srdf": chosen.srdf,
        "--inertia": chosen.inertia != "checked",
        "--strict": chosen.strict,
        "--no-meshes": chosen.no_meshes,
        "--duration": chosen.duration is not None,
        "--h": chosen.h is not None,
    }
    names = [name for name, value in given.items() if value]
    if names:
        raise saltus.ModelError(
            f"{chosen.file} is a recorded run; {', '.join(names)} can be given with a URDF file"
        )


def _simulated(chosen: argparse.Namespace) -> saltus.Trajectory:
    model = load(chosen, visuals=True)
    if chosen.q or chosen.v:
        return _run(chosen, model, dict(chosen.q))
    start = _start(model)
    run = _run(chosen, model, start)
    if len(run) == 1 or np.abs(run.q - run.q[0]).max(initial=0.0) > MOVED:
        return run
    for coordinate in model.coordinates:
        for nudge in NUDGES if coordinate.unit != "1" else ():
            value = float(np.clip(nudge, coordinate.lower, coordinate.upper))
            try:
                moved = _run(chosen, model, start | {coordinate.name: value})
            except saltus.ModelError:
                continue  # bodies overlap there
            if value and np.abs(moved.q - moved.q[0]).max() > MOVED:
                print(f"at rest as it stands; started with {coordinate.name} = {value:g}")
                return moved
    return run


def _start(model: saltus.Model) -> dict[str, float]:
    """Return the coordinates to start with: 0, or the nearest where bodies do not overlap."""
    neutral = model.neutral()
    apart = saltus.resolve_overlap(model, neutral)
    if np.array_equal(apart, neutral):
        return {}
    moved = dict(zip(model.coordinate_names, apart.tolist(), strict=True))
    words = ", ".join(
        f"{name} = {value:g}"
        for (name, value), zero in zip(moved.items(), neutral, strict=True)
        if abs(value - zero) > MOVED
    )
    print(f"bodies overlap as it stands; moved apart: {words}")
    return moved


def _run(chosen: argparse.Namespace, model: saltus.Model, q: dict[str, float]) -> saltus.Trajectory:
    return saltus.simulate(
        model,
        state=first_state(model, q, dict(chosen.v)),
        duration=DURATION if chosen.duration is None else chosen.duration,
        h=STEP if chosen.h is None else chosen.h,
        certify=True,
        record_contacts=True,
    )
