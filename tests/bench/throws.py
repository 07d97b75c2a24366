"""Bodies thrown at random: how many runs end, gain no energy and do not sink, and by which arcs.

    python -m tests.bench.throws --count 600 --seed 1
    python -m tests.bench.throws --seed 1 --scene 17    # this one again

One to three free bodies fall on a floor, into a groove or into a pit, of any restitution and
friction. The table says what became of the runs, the lines below it which scenes are to blame.
Ctrl-C ends early.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np
from tqdm import tqdm

import saltus
from tests.bench.table import bullets, grid

DURATION = 2.0  # [s]
STEPS = (0.005, 0.01)  # [s]
RESTITUTIONS = (0.0, 0.3, 0.5, 0.9)
FRICTIONS = (0.0, 0.2, 0.8, 2.0)
SPIN = 20.0  # [rad/s] at most
PLACES = {
    "floor": [(0, 0, 1)],
    "groove": [(1, 0, 1), (-1, 0, 1)],
    "pit": [(1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1)],
}
SHAPES = {
    "box": saltus.Box((0.1, 0.2, 0.3)),
    "cube": saltus.Box((0.1, 0.1, 0.1)),
    "can": saltus.Cylinder(0.1, 0.1),
    "capsule": saltus.Capsule(0.1, 0.2),
    "ball": saltus.Sphere(0.1),
    "ellipsoid": saltus.Ellipsoid((0.1, 0.15, 0.2)),
    "hull": None,  # its corners are random
}
APART = 0.9  # [m] between the bodies' heights; the largest is 0.75 m long

# A midpoint swings by (h omega)^2 / 8, which 40 rad/s on landing make a percent or two.
GAIN = 0.025  # of the largest kinetic energy
SINK = 1e-9  # [m]
SLOW, PATIENCE = 5.0, 60.0  # [s] of CPU for a throw: told, and no more

RUNGS = ("halved", "unlocated", "stopped")  # each is worse than the ones before


@dataclass
class Scene:
    names: list[str]
    place: str
    restitution: float
    friction: float
    h: float
    model: saltus.Model
    state: saltus.State

    def __str__(self) -> str:
        return (
            f"{' + '.join(self.names)}, {self.place}, e = {self.restitution:g}, "
            f"mu = {self.friction:g}, h = {self.h:g}"
        )


@dataclass
class Counts:
    """What became of the runs, and which scenes are to blame."""

    ended: int = 0  # runs without an error
    steps: int = 0
    warned: int = 0
    errors: Counter[str] = field(default_factory=Counter)
    gains: int = 0
    sinks: int = 0
    slowest: float = 0.0  # [s] of CPU
    steps_on: Counter[str] = field(default_factory=Counter)
    runs_on: Counter[str] = field(default_factory=Counter)
    blame: list[str] = field(default_factory=list)


def random_shape(name: str, rng: np.random.Generator) -> object:
    if name != "hull":
        return SHAPES[name]
    return saltus.Convex(rng.uniform(-0.15, 0.15, (int(rng.integers(6, 13)), 3)))


def random_scene(seed: int, number: int) -> Scene:
    """Return a scene: it depends on these two numbers alone."""
    rng = np.random.default_rng([seed, number])
    names = [str(name) for name in rng.choice(list(SHAPES), size=rng.integers(1, 4))]
    place = str(rng.choice(list(PLACES)))
    restitution, friction = float(rng.choice(RESTITUTIONS)), float(rng.choice(FRICTIONS))
    builder = saltus.ModelBuilder("throw")
    for i, normal in enumerate(PLACES[place]):
        builder.add_half_space(f"plane_{i}", normal)
    builder.set_default_contact(restitution=restitution, friction=friction)
    q, v = [], []
    for i, name in enumerate(names):
        builder.add_body(f"{name}_{i}", random_shape(name, rng), mass=float(rng.choice([1, 1, 5])))
        at = [*rng.uniform(-0.1, 0.1, 2), 1 + APART * i + rng.uniform(0, 0.1)]
        axis = rng.normal(size=3)
        spin = rng.uniform(0, SPIN) * axis / np.linalg.norm(axis)
        q += [*at, *rng.normal(size=4)]
        v += [*rng.uniform(-2, 2, 3), *spin]
    model = builder.build()
    state = model.state(model.normalized(q), v)
    return Scene(names, place, restitution, friction, float(rng.choice(STEPS)), model, state)


def simulated(scene: Scene) -> tuple[saltus.Trajectory, bool]:
    """Return a scene's run and whether it warned."""
    start = time.process_time()

    def give_up(_: float) -> None:
        if time.process_time() - start > PATIENCE:
            raise TimeoutError(f"not done after {PATIENCE:g} s of CPU")

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        run = saltus.simulate(
            scene.model, state=scene.state, duration=DURATION, h=scene.h, progress=give_up
        )
    return run, any(issubclass(each.category, saltus.StepWarning) for each in told)


def rises(run: saltus.Trajectory) -> float:
    """Return the largest rise of the energy, as a part of the largest kinetic energy."""
    return float((run.total - np.minimum.accumulate(run.total)).max() / run.kinetic.max())


def depth(run: saltus.Trajectory) -> float:
    """Return the least gap [m] of all rows."""
    return float(min(run.model.gaps(q).phi.min() for q in run.q))


def worst_rungs(run: saltus.Trajectory, h: float) -> dict[int, str]:
    """Return of each step that is not one arc's the worst rung it needed."""
    found: dict[int, str] = {}
    for row in run.fallbacks:
        step, rung = int(row["t"] / h + 1e-6), str(row["rung"])
        found[step] = max(found.get(step, rung), rung, key=RUNGS.index)
    return found


def add_run(counts: Counts, number: int, scene: Scene) -> None:
    """Throw one scene and count what became of it."""
    start = time.process_time()
    try:
        run, warned = simulated(scene)
        if not run.complete:
            raise KeyboardInterrupt
    except (RuntimeError, ValueError, TimeoutError) as error:
        counts.errors[f"{type(error).__name__}: {error}"] += 1
        counts.blame.append(f"scene {number} ends in an error: {scene}")
        return
    finally:
        spent = time.process_time() - start
        counts.slowest = max(counts.slowest, spent)
        if spent > SLOW:
            counts.blame.append(f"scene {number} takes {spent:.1f} s of CPU: {scene}")
    counts.ended += 1
    counts.warned += warned
    counts.steps += len(run) - 1
    rungs = worst_rungs(run, scene.h)
    counts.steps_on.update(rungs.values())
    counts.runs_on[max(rungs.values(), key=RUNGS.index, default="none")] += 1
    if (rise := rises(run)) > GAIN:
        counts.gains += 1
        counts.blame.append(f"scene {number} gains {rise:.1%}: {scene}")
    if (least := depth(run)) < -SINK:
        counts.sinks += 1
        counts.blame.append(f"scene {number} sinks {-least:.1e} m: {scene}")


def markdown(counts: Counts) -> str:
    plain = counts.steps - counts.steps_on.total()
    rows = [
        ["runs", str(counts.ended + counts.errors.total())],
        ["end in an error", str(counts.errors.total())],
        ["warn (StepWarning)", str(counts.warned)],
        [f"gain more than {GAIN:.1%} of the kinetic energy", str(counts.gains)],
        [f"sink more than {SINK:g} m", str(counts.sinks)],
        ["slowest throw [s] of CPU", f"{counts.slowest:.2f}"],
    ]
    rungs = [
        [rung, share(on, counts.steps), share(counts.runs_on[rung], counts.ended)]
        for rung, on in [("none", plain), *((rung, counts.steps_on[rung]) for rung in RUNGS)]
    ]
    parts = [grid(["what", "how many"], rows), grid(["worst rung", "of steps", "of runs"], rungs)]
    texts = [f"{n} x {text}" for text, n in counts.errors.most_common(10)]
    return "\n\n".join(part for part in [*parts, bullets(texts), bullets(counts.blame)] if part)


def share(part: int, whole: int) -> str:
    return f"{part / whole:.3%}" if whole else "-"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=100, help="scenes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scene", type=int, help="this one alone")
    parser.add_argument("--seconds", type=float, default=np.inf, help="of CPU, then no more scenes")
    args = parser.parse_args()
    numbers = range(args.count) if args.scene is None else [args.scene]
    counts, start = Counts(), time.process_time()
    with suppress(KeyboardInterrupt):  # then of the scenes before
        for number in tqdm(numbers, unit="throw", disable=None):
            add_run(counts, number, random_scene(args.seed, number))
            if time.process_time() - start > args.seconds:
                break
    print(markdown(counts))


if __name__ == "__main__":
    main()
