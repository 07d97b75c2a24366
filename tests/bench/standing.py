"""A quadruped on its feet under servos, beside MuJoCo, and what servos add to a smooth step.

    python -m tests.bench.standing

ANYmal of example-robot-data stands on a floor with friction, its joints held by servos, limits in
force. Both engines have its URDF, h = 2 ms and the same gains; else MuJoCo has its defaults, and it
watches the floor alone where saltus watches the robot's own links too. The second table is a step
of 1 ms of the same robot in the air, without contacts and limits. The engines take turns; the least
time of each counts.
"""

from __future__ import annotations

import argparse
import importlib.util
import time
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Callable

import numpy as np

import saltus
from tests.bench.scenes import robots_folder, root_link
from tests.bench.table import grid

H, FRICTION = 0.002, 0.7
RATE = 150.0  # [rad/s] of a servo on the inertia that it feels, critically damped
SETTLE = 2.0  # [s] until it stands still, untimed
AIR_H, AIR_RATE = 0.001, 0.2  # [s], [rad/s] of every joint at the start
FOLDER = "anymal_b_simple_description"
Gains = dict[str, tuple[float, float]]
Steps = Callable[[int], object]


def read(effects: saltus.JointEffects | str = "all") -> saltus.ModelBuilder:
    folder = robots_folder() / FOLDER
    return saltus.read_urdf(
        folder / "robots/anymal.urdf",
        package_dirs=[folder.parent, folder.parent.parent],
        srdf=folder / "srdf/anymal.srdf",
        root_joint="floating",
        visuals=False,
        effects=effects,
    )


def gains_of(model: saltus.Model, q: np.ndarray) -> Gains:
    """Return kp and kd of each joint by the inertia that it feels, 1 / (M^-1)_ii."""
    felt = 1 / np.linalg.inv(model.mass_matrix(q)).diagonal()
    turning = [joint for joint in model.joints if len(joint.velocities) == 1]
    inertias = {joint.name: felt[joint.velocities[0]] for joint in turning}
    return {name: (RATE**2 * felt, 2 * RATE * felt) for name, felt in inertias.items()}


def add_servos(builder: saltus.ModelBuilder, gains: Gains) -> saltus.ModelBuilder:
    for name, (kp, kd) in gains.items():
        builder.add_position_servo(name, joint=name, kp=kp, kd=kd)
    return builder


def standing() -> tuple[saltus.Model, np.ndarray, Gains]:
    """Return the robot, its pose with the lowest foot on the floor, and its gains."""
    builder = read().add_floor(restitution=0, friction=FRICTION)
    model = builder.build()
    q = np.array(model.state("standing").q)
    q[2] -= model.gaps(q).phi[[name.endswith("floor") for name in model.pair_names]].min()
    gains = gains_of(model, q)
    return add_servos(builder, gains).build(), q, gains


def targets(model: saltus.Model, q: np.ndarray) -> np.ndarray:
    return np.array([q[model.coordinate(name)] for name in model.control_names])


def of_saltus(model: saltus.Model, q: np.ndarray) -> tuple[Steps, dict[str, float]]:
    """Return what makes steps from where it stands, and the report of the last one."""
    stepper, u = saltus.Stepper(model, H), targets(model, q)
    state = model.state(q)
    for _ in range(round(SETTLE / H)):
        state = stepper.advance(state, control=u)
    report = stepper.report
    facts = {
        "contacts": sum(contact.pair.endswith("floor") for contact in report.contacts),
        "iterations": report.iterations,
        "speed": np.abs(model.velocity(state)).max(),
    }

    def steps(count: int) -> None:
        nonlocal state
        for _ in range(count):
            state = stepper.advance(state, control=u)

    return steps, facts


def of_mujoco(model: saltus.Model, q: np.ndarray, gains: Gains) -> tuple[Steps, dict[str, float]]:
    """Return the same of MuJoCo."""
    import mujoco

    theirs = mujoco.MjModel.from_xml_string(mujoco_text(gains))
    data = mujoco.MjData(theirs)
    data.qpos[:7] = [*q[:3], q[6], *q[3:6]]  # w first
    for name in gains:
        at = mujoco.mj_name2id(theirs, mujoco.mjtObj.mjOBJ_JOINT, name)
        data.qpos[theirs.jnt_qposadr[at]] = q[model.coordinate(name)]
        actuator = mujoco.mj_name2id(theirs, mujoco.mjtObj.mjOBJ_ACTUATOR, name)
        data.ctrl[actuator] = q[model.coordinate(name)]
    mujoco.mj_step(theirs, data, nstep=round(SETTLE / H))
    facts = {
        "contacts": data.ncon,
        "iterations": int(data.solver_niter[0]),
        "speed": np.abs(data.qvel).max(),
    }
    return lambda count: mujoco.mj_step(theirs, data, nstep=count), facts


def mujoco_text(gains: Gains) -> str:
    """Return the robot on a plane as MJCF."""
    import mujoco

    robot = ET.fromstring((robots_folder() / FOLDER / "robots/anymal.urdf").read_text())
    for link in robot.iterfind("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    small = dict.fromkeys(("ixx", "iyy", "izz"), "3e-6") | dict.fromkeys(("ixy", "ixz", "iyz"), "0")
    for inertia in robot.iterfind("link[@name='base']/inertial/inertia"):
        inertia.attrib = small  # that of the file is of no body, which MuJoCo refuses
    text = ET.tostring(robot, encoding="unicode")
    free = (
        '<mujoco><compiler balanceinertia="true" fusestatic="true"/></mujoco><link name="world"/>'
        '<joint name="root" type="floating"><parent link="world"/>'
        f'<child link="{root_link(text)}"/></joint></robot>'
    )
    spec = mujoco.MjSpec.from_string(text.replace("</robot>", free))
    for geom in spec.geoms:
        geom.contype, geom.conaffinity, geom.friction[0] = 0, 1, FRICTION
    mjcf = ET.fromstring(spec.to_xml())
    plane = {"type": "plane", "size": "9 9 1", "contype": "1", "friction": f"{FRICTION} 0 0"}
    ET.SubElement(mjcf.find("worldbody"), "geom", plane)
    actuators = ET.SubElement(mjcf, "actuator")
    for name, (kp, kd) in gains.items():
        servo = {"name": name, "joint": name, "kp": str(kp), "kv": str(kd)}
        ET.SubElement(actuators, "position", servo)
    ET.SubElement(mjcf, "option", {"timestep": str(H)})
    return ET.tostring(mjcf, encoding="unicode")


def in_the_air(drive: str) -> Steps:
    """Return steps of the robot that falls freely from its stand, with what drives its joints."""
    kinds = saltus.JointEffects
    acting = {"bare": kinds.none, "damping": kinds.damping, "servos": kinds.motors}
    builder = read(acting[drive])
    model = builder.build()
    q = np.array(model.state("standing").q)
    gains = gains_of(model, q)
    if drive == "servos":
        builder = add_servos(builder, gains)
    elif drive == "damping":
        for name, (_, kd) in gains.items():
            builder.set_damping(name, kd)
    model = builder.build()
    v = np.where(np.arange(model.n_v) < 6, 0.0, AIR_RATE)
    u = targets(model, q) if model.control_names else None
    start = model.state(q, v)

    def steps(count: int) -> None:
        stepper, state = saltus.Stepper(model, AIR_H, collisions=False), start
        for _ in range(count):
            state = stepper.advance(state, control=u)

    return steps


def least(runs: dict[str, Steps], count: int, passes: int) -> dict[str, float]:
    """Return the least time of a step [us] of each; they take turns."""
    best = dict.fromkeys(runs, np.inf)
    for _ in range(passes):
        for name, steps in runs.items():
            start = time.thread_time()
            steps(count)
            best[name] = min(best[name], 1e6 * (time.thread_time() - start) / count)
    return best


def stand_table(count: int, passes: int) -> str:
    model, q, gains = standing()
    made = {"saltus": of_saltus(model, q)}
    if importlib.util.find_spec("mujoco"):
        made["MuJoCo"] = of_mujoco(model, q, gains)
    times = least({name: steps for name, (steps, _) in made.items()}, count, passes)
    rows = [
        [
            name,
            f"{times[name]:.1f}",
            f"{times[name] / times['MuJoCo']:.2f}" if "MuJoCo" in times else "-",
            f"{facts['contacts']}",
            f"{facts['iterations']}",
            f"{facts['speed']:.0e}",
        ]
        for name, (_, facts) in made.items()
    ]
    head = ["standing", "step [µs]", "/ MuJoCo", "contacts", "iterations", "speed [rad/s]"]
    return grid(head, rows)


def air_table(count: int, passes: int) -> str:
    times = least({d: in_the_air(d) for d in ("bare", "damping", "servos")}, count, passes)
    rows = [[d, f"{t:.2f}", f"{100 * (t / times['bare'] - 1):.0f} %"] for d, t in times.items()]
    return grid(["in the air", "step [µs]", "more than bare"], rows)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--steps", type=int, default=200, help="in a pass")
    parser.add_argument("--passes", type=int, default=25)
    args = parser.parse_args()
    warnings.simplefilter("ignore", saltus.ModelWarning)
    print(stand_table(args.steps, args.passes), air_table(args.steps, args.passes), sep="\n\n")


if __name__ == "__main__":
    main()
