"""Towers of boxes that stand by friction, in saltus and (where it is installed) in MuJoCo.

Both step 10 ms, and MuJoCo also its default of 2 ms; its other settings are its defaults.
"""

import argparse
import importlib.util
import time

import numpy as np

import saltus

HALF = (0.2, 0.15, 0.1)
FRICTION = 0.5


def of_saltus(boxes, duration, h):
    """Return [ms] a step, [m] drift, [m] overlap of a tower of boxes of 1 kg."""
    builder = saltus.ModelBuilder("tower").add_half_space("floor", (0, 0, 1))
    builder.set_default_contact(restitution=0, friction=FRICTION)
    for i in range(boxes):
        builder.add_link(f"box_{i}", saltus.solid_box(1.0, HALF))
        builder.add_shape(f"box_{i}", saltus.Box(HALF))
        at = saltus.Pose((0, 0, HALF[2] * (2 * i + 1)))
        builder.add_joint(
            f"box_{i}", saltus.JointType.floating, parent="world", child=f"box_{i}", X_PJ=at
        )
    model = builder.build()
    stepper, state = saltus.Stepper(model, h), model.state()
    steps, start = round(duration / h), time.perf_counter()
    for _ in range(steps):
        state = stepper.advance(state)
    spent = time.perf_counter() - start
    at = state.q.reshape(boxes, 7)[:, :3]
    return 1e3 * spent / steps, abs(at).max(), max(0.0, -min(np.diff(at[:, 2], prepend=0)))


def of_mujoco(boxes, duration, h):
    """Return the same of MuJoCo."""
    import mujoco

    size = " ".join(map(str, HALF))
    bodies = "".join(
        f'<body pos="0 0 {HALF[2] * (2 * i + 1)}"><freejoint/>'
        f'<geom type="box" size="{size}" mass="1" friction="{FRICTION} 0 0"/></body>'
        for i in range(boxes)
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{h}"/><worldbody>'
        f'<geom type="plane" size="5 5 1" friction="{FRICTION} 0 0"/>{bodies}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    steps, start = round(duration / h), time.perf_counter()
    for _ in range(steps):
        mujoco.mj_step(model, data)
    spent = time.perf_counter() - start
    at = data.qpos.reshape(boxes, 7)[:, :3] - np.outer(2 * np.arange(boxes) + 1, (0, 0, HALF[2]))
    return 1e3 * spent / steps, abs(at).max(), max(0.0, -min(np.diff(at[:, 2], prepend=0)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=10.0, help="of a run [s]")
    parser.add_argument("--boxes", type=int, nargs="+", default=[1, 3, 10])
    args = parser.parse_args()
    runs = [("saltus", of_saltus, 0.01)]
    if importlib.util.find_spec("mujoco"):
        runs += [("MuJoCo", of_mujoco, 0.01), ("MuJoCo", of_mujoco, 0.002)]
    print("| boxes | engine | h [ms] | [ms] a step | CPU / time | drift [m] | overlap [m] |")
    print("|---|---|---|---|---|---|---|")
    for boxes in args.boxes:
        for name, run, h in runs:
            cost, drift, overlap = run(boxes, args.duration, h)
            print(
                f"| {boxes} | {name} | {1e3 * h:g} | {cost:.3f} | {cost / (1e3 * h):.3f} | "
                f"{drift:.1e} | {overlap:.1e} |"
            )


if __name__ == "__main__":
    main()
