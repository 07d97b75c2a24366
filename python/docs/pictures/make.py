"""Makes the pictures of README and manual, beside this file: the animation, one of each example.

    .venv/bin/python python/docs/pictures/make.py [--to FOLDER] [NAME...]

Needs Chromium, matplotlib, Pillow and websockets. The pages of the runs draw the pictures.
"""

from __future__ import annotations

import argparse
import base64
import io
import runpy
import sys
import tempfile
import warnings
from contextlib import redirect_stdout
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

import saltus

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))

from browser import Browser, Tab  # noqa: E402  # the browser that the tests drive

SMALL = (320, 240)  # [px] of a picture of an example
PERIODS, RATE = 2, 20.0  # of the cradle in the animation; [1/s] frames


class Shot(NamedTuple):
    """What is shown of an example: which of its runs, when, from where."""

    time: float  # [s]
    run: int = -1
    view: str = "corner"
    example: str = ""  # where the picture has another name
    until: float = 0.0  # [s] the run is made again, so long: the camera sees all that happens


EXAMPLES = {
    "cradle": Shot(1.0, view="front", example="hello_cradle"),
    "billiard_break": Shot(0.16, view="top", until=0.18),
    "galton_board": Shot(1.62, view="front"),
    "box_on_edge": Shot(0.319275),
    "tower": Shot(0.05),
    "incline": Shot(0.7, view="front"),
    "pendulum_and_wall": Shot(0.15, view="front"),
    "where_it_stands": Shot(0.3),
    "stands_up": Shot(2.0, run=0),
}


def runs_of(example: str) -> list[saltus.Trajectory]:
    """Run an example, and return what it simulates."""
    made = []
    simulate = saltus.simulate

    def note(*args, **more):
        made.append(simulate(*args, **more))
        return made[-1]

    saltus.simulate = note
    try:
        with redirect_stdout(io.StringIO()):
            runpy.run_path(str(ROOT / "examples" / f"{example}.py"))
    finally:
        saltus.simulate = simulate
    return made


def open_page(browser: Browser, run: saltus.Trajectory, size: tuple[int, int], view: str) -> Tab:
    """Return the page of a run, as if it were about to make a video of this size."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "run.html"
        run.html(page)
        tab = browser.open(page.as_uri()).ready()
    tab.run("saltus.page.stage.sun.castShadow = true; 0")  # also where no card draws
    tab.run(f"saltus.page.look({view!r}); saltus.page.beginVideo({list(size)}, 1); 0")
    return tab


def frame(tab: Tab, time: float) -> Image.Image:
    """Return what the page shows at a time."""
    url = tab.run(
        f"(saltus.page.clock.time = {float(time)!r}, saltus.page.render(),"
        " saltus.page.stage.canvas.toDataURL('image/png'))"
    )
    return Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2]))).convert("RGB")


def make_example(browser: Browser, name: str, to: Path) -> None:
    """Write the picture of an example."""
    shot = EXAMPLES[name]
    run = runs_of(shot.example or name)[shot.run]
    if shot.until:
        run = saltus.simulate(
            run.require_model(), state=run.state(0), duration=shot.until, h=run.options.h
        )
    tab = open_page(browser, run, (2 * SMALL[0], 2 * SMALL[1]), shot.view)
    picture = frame(tab, shot.time).resize(SMALL, Image.Resampling.LANCZOS)
    picture.save(to / f"{name}.webp", quality=80, method=6)
    tab.close()


def cradle() -> saltus.Trajectory:
    """Return a cradle of five over one period, two balls let go."""
    model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_5.urdf")
    return saltus.simulate(model, q={"swing_0": 0.3, "swing_1": 0.3}, duration=2.1, h=0.01)


def heap() -> saltus.Trajectory:
    """Return boxes that fall on a floor and on each other, and come to rest."""
    scene = saltus.ModelBuilder("heap").add_floor(restitution=0.3, friction=0.5)
    scene.set_default_contact(restitution=0.2, friction=0.5)
    start = np.random.default_rng(9)  # all steps are exact; of some starts a few lose energy
    for i in range(5):
        half = start.uniform(0.06, 0.14, 3)
        where = (*start.uniform(-0.2, 0.2, 2), 0.3 + 0.3 * i)
        X = saltus.Pose.from_rpy(*start.uniform(-1, 1, 3), p=where)
        scene.add_body(f"box_{i}", saltus.Box(half), density=800, X=X)
    run = saltus.simulate(scene.build(), duration=4.1, h=0.005)
    assert not len(run.fallbacks)
    return run


def make_animation(browser: Browser, to: Path) -> None:
    """Write the animation: a cradle, and a heap that comes to rest."""
    swinging = cradle()
    period = 4.0 * swinging.impacts["t"][0]  # the cradle's part repeats
    tabs = [
        open_page(browser, swinging, (400, 300), "front"),
        open_page(browser, heap(), (400, 300), "corner"),
    ]
    frames = []
    for k in range(round(PERIODS * period * RATE)):
        sheet = Image.new("RGB", (800, 300), "white")
        sheet.paste(frame(tabs[0], (k / RATE) % period), (0, 0))
        sheet.paste(frame(tabs[1], k / RATE), (400, 0))
        frames.append(sheet)
    frames[0].save(
        to / "animation.webp", save_all=True, append_images=frames[1:], loop=0,
        duration=round(1000 / RATE), quality=50, method=6,
    )  # fmt: skip
    for tab in tabs:
        tab.close()


def make_first(to: Path) -> None:
    """Run the first program of the README, which draws a picture, and keep that."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    code = text.split("```python\n")[1].split("```")[0]
    with tempfile.TemporaryDirectory() as folder, redirect_stdout(io.StringIO()):
        exec(code.replace('"cradle.png"', repr(f"{folder}/cradle.png")), {})
        picture = Image.open(f"{folder}/cradle.png").convert("RGB")
    picture.resize((800, 460), Image.Resampling.LANCZOS).save(to / "first.webp", quality=85)


def make_plot(to: Path) -> None:
    """Draw a driven pendulum between stops, for the page on plots."""
    builder = saltus.ModelBuilder("pendulum")
    builder.add_link("bob", saltus.BodyInertia(1.0, (0, 0, -1.0)))
    builder.add_joint("swing", "revolute", parent="world", child="bob", axis=(0, 1, 0))
    builder.set_limit("swing", -0.5, 1.5, restitution=0.7).add_motor("push", joint="swing")
    model = builder.set_damping("swing", 0.2).build()
    run = saltus.simulate(
        model, {"swing": 1.2}, duration=4.0, control=lambda now: {"push": 3 * np.cos(2 * now.t)}
    )
    with tempfile.TemporaryDirectory() as folder:
        figure = run.plot(f"{folder}/plot.png")
        picture = Image.open(f"{folder}/plot.png").convert("RGB")
    width, height = (round(100 * inches) for inches in figure.get_size_inches())
    picture = picture.resize((width, height), Image.Resampling.LANCZOS)
    picture.save(to / "plot.webp", quality=80, method=6)


def main() -> None:
    """Make the pictures that are named, or all."""
    parser = argparse.ArgumentParser(description="Makes the pictures of README and manual.")
    parser.add_argument("--to", type=Path, default=HERE, metavar="FOLDER")
    parser.add_argument("names", nargs="*", metavar="NAME")
    chosen = parser.parse_args()
    warnings.simplefilter("ignore", saltus.ModelWarning)
    names = chosen.names or ["animation", "first", "plot", *EXAMPLES]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        browser = Browser(Path(folder))
        try:
            for name in names:
                if name == "animation":
                    make_animation(browser, chosen.to)
                elif name == "first":
                    make_first(chosen.to)
                elif name == "plot":
                    make_plot(chosen.to)
                else:
                    make_example(browser, name, chosen.to)
                size = (chosen.to / f"{name}.webp").stat().st_size
                print(f"{name}.webp: {size / 1000:.0f} kB")
        finally:
            browser.close()


if __name__ == "__main__":
    main()
