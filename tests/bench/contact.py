"""Where contact is: what bodies that rest, slide and fall cost, beside MuJoCo.

    python -m tests.bench.contact                         # all of them
    python -m tests.bench.contact --scene tower heap      # those whose names start so

saltus steps 10 ms, MuJoCo its default of 2 ms with its other defaults, so that a ratio of 5 per
step is par per simulated second. Both have the same bodies on the same plane; MuJoCo is left out
where it is not installed. A scene is run from its start anew in every pass; the least time counts.
"""

from __future__ import annotations

import argparse
import importlib.util
import time
import warnings
from collections.abc import Callable

import numpy as np

import saltus
from tests.bench.contact_scenes import Body, Scene, Vector, scenes
from tests.bench.table import grid

H, THEIR_H = 0.01, 0.002


def model_of(scene: Scene) -> saltus.Model:
    builder = saltus.ModelBuilder(scene.name).add_floor()
    builder.set_default_contact(restitution=scene.restitution, friction=scene.friction)
    for k, (normal, offset) in enumerate(scene.walls):
        builder.add_half_space(f"wall_{k}", normal, offset)
    for peg in scene.pegs:
        builder.add_shape("world", saltus.Sphere(peg.size[0]), saltus.Pose(peg.place))
    for i, body in enumerate(scene.bodies):
        shape = saltus.Sphere(body.size[0]) if body.is_ball else saltus.Box(body.size)
        X = saltus.Pose(body.place)
        builder.add_body(f"body_{i}", shape, mass=body.mass, X=X, joint_name=f"free_{i}")
    return builder.build()


def of_saltus(scene: Scene) -> tuple[Callable[[], list[float]], Callable[[], dict[str, str]]]:
    """Return a pass, the seconds of each of its steps, and what is told of the last pass."""
    model = model_of(scene)
    v = {
        f"free_{i}_v{axis}": each
        for i, body in enumerate(scene.bodies)
        for axis, each in zip("xyz", body.velocity, strict=True)
    }
    start = model.state(v=v)
    facts: dict[str, str] = {}

    def run() -> list[float]:
        stepper, state = saltus.Stepper(model, H), start
        for _ in range(round(scene.before / H)):
            state = stepper.advance(state)
        spent, arcs, iterations, rungs = [], 0, 0, 0
        for _ in range(round(scene.seconds / H)):
            begin = time.thread_time()
            state = stepper.advance(state)
            spent.append(time.thread_time() - begin)
            arcs += stepper.report.arcs
            iterations += stepper.report.iterations
            rungs += len(stepper.report.fallbacks)
        steps = len(spent)
        facts["arcs"] = f"{arcs / steps:.1f}"
        facts["iterations"] = f"{iterations / steps:.1f}"
        facts["fallbacks"] = str(rungs)
        facts["contacts"] = str(len(stepper.report.contacts))
        facts["drift"] = f"{np.abs(state.q - start.q).max():.0e}" if scene.rests else "-"
        return spent

    return run, lambda: facts


def urdf_of(scene: Scene) -> str:
    """Return the same for programs that read files; bodies start without velocity."""
    bodies = "".join(urdf_body(i, body) for i, body in enumerate(scene.bodies))
    pegs = "".join(
        f'<collision><origin xyz="{words(peg.place)}"/><geometry><sphere radius="{peg.size[0]}"/>'
        "</geometry></collision>"
        for peg in scene.pegs
    )
    planes = "".join(
        f'<half_space name="plane_{i}" normal="{words(normal)}" offset="{offset}"/>'
        for i, (normal, offset) in enumerate([((0.0, 0.0, 1.0), 0.0), *scene.walls])
    )
    return (
        f'<robot name="{scene.name}"><link name="world">{pegs}</link>{bodies}<saltus>{planes}'
        f'<contact restitution="{scene.restitution}" friction="{scene.friction}"/></saltus></robot>'
    )


def urdf_body(i: int, body: Body) -> str:
    shape, squares = f'<sphere radius="{body.size[0]}"/>', [body.size[0] ** 2 / 5] * 3
    if not body.is_ball:
        shape = f'<box size="{words([2 * each for each in body.size])}"/>'
        squares = [each**2 / 3 for each in body.size]
    xx, yy, zz = (body.mass * (sum(squares) - each) for each in squares)
    return (
        f'<joint name="free_{i}" type="floating"><parent link="world"/><child link="body_{i}"/>'
        f'<origin xyz="{words(body.place)}"/></joint><link name="body_{i}">'
        f'<inertial><mass value="{body.mass}"/>'
        f'<inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"<collision><geometry>{shape}</geometry></collision></link>"
    )


def mjcf_of(scene: Scene) -> str:
    bodies = []
    for i, body in enumerate(scene.bodies):
        kind = "sphere" if body.is_ball else "box"
        bodies.append(
            f'<body name="body_{i}" pos="{words(body.place)}"><freejoint/>'
            f'<geom type="{kind}" size="{words(body.size)}" mass="{body.mass}" '
            f'friction="{scene.friction} 0 0"/></body>'
        )
    planes = [((0.0, 0.0, 1.0), 0.0), *scene.walls]
    pegs = "".join(
        f'<geom type="sphere" size="{peg.size[0]}" pos="{words(peg.place)}" '
        f'friction="{scene.friction} 0 0"/>'
        for peg in scene.pegs
    )
    walls = "".join(
        f'<geom type="plane" size="9 9 1" zaxis="{words(normal)}" '
        f'pos="{words([offset * each for each in normal])}" friction="{scene.friction} 0 0"/>'
        for normal, offset in planes
    )
    return (
        f'<mujoco><option timestep="{THEIR_H}"/><worldbody>{walls}{pegs}{"".join(bodies)}'
        "</worldbody></mujoco>"
    )


def words(numbers: Vector | list[float]) -> str:
    return " ".join(map(str, numbers))


def of_mujoco(scene: Scene) -> Callable[[], list[float]]:
    """Return a pass, the seconds of each of its steps."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(mjcf_of(scene))
    data = mujoco.MjData(model)

    def run() -> list[float]:
        mujoco.mj_resetData(model, data)
        for i, body in enumerate(scene.bodies):
            data.qvel[6 * i : 6 * i + 3] = body.velocity
        if scene.before > 0:
            mujoco.mj_step(model, data, nstep=round(scene.before / THEIR_H))
        steps = round(scene.seconds / THEIR_H)
        begin = time.thread_time()
        mujoco.mj_step(model, data, nstep=steps)
        return [(time.thread_time() - begin) / steps] * steps

    return run


def row_of(scene: Scene, passes: int) -> list[str]:
    """Run one scene in turns and return its row of the table."""
    ours, facts = of_saltus(scene)
    theirs = of_mujoco(scene) if importlib.util.find_spec("mujoco") else None
    mine, other = [], []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", saltus.StepWarning)
        for _ in range(passes):
            mine.append(ours())
            if theirs:
                other.append(theirs())
    best = np.min(mine, axis=0)
    mean = best.mean()
    told = facts()
    row = [scene.name, f"{1e6 * mean:.0f}", f"{best.max() / np.median(best):.1f}"]
    if other:
        peer = np.min(other, axis=0).mean()
        row += [f"{1e6 * peer:.0f}", f"{mean / peer:.1f}", f"{mean / peer * THEIR_H / H:.2f}"]
    else:
        row += ["-"] * 3
    return row + [told[key] for key in ("contacts", "arcs", "iterations", "fallbacks", "drift")]


COLUMNS = [
    "scene", "step [us]", "worst / median", "mj_step [us]", "ratio", "a second", "contacts",
    "arcs", "iterations", "fallbacks", "drift [m]",
]  # fmt: skip

HOW = f"""\
Boxes and balls on a floor, the heaps between four walls, and balls that fall through the pegs of a
Galton board. saltus steps {1e3 * H:g} ms, MuJoCo {1e3 * THEIR_H:g} ms with its defaults; "a
second" is the ratio of what a simulated second costs.
The worst step is over the median one; arcs and iterations are of a step. In saltus nothing
overlaps, and what rests drifts by rounding; in MuJoCo contacts are soft, and friction creeps.
What has moved by rounding alone for eight steps stands still in saltus, and steps in which
nothing changes are not made again: the rows "at rest", and some steps of the separate boxes."""


def measure(*, quick: bool) -> list[list[str]]:
    """Run all scenes, or a small one of each kind."""
    few = {"boxes 16", "tower 5", "heap 8"}
    return [
        row_of(scene, 1 if quick else 3) for scene in scenes() if not quick or scene.name in few
    ]


def markdown(rows: list[list[str]] | None) -> str:
    return f"{HOW}\n\n{grid(COLUMNS, rows)}" if rows else "(not measured)"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", nargs="+", help="starts of names; default all")
    parser.add_argument("--passes", type=int, default=3)
    args = parser.parse_args()
    print(grid(COLUMNS, []))
    for scene in scenes():
        if args.scene is None or any(scene.name.startswith(each) for each in args.scene):
            print(f"| {' | '.join(row_of(scene, args.passes))} |", flush=True)


if __name__ == "__main__":
    main()
