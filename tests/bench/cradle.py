"""The emblem: a touching cradle of three balls for 60 s, from Python."""

from __future__ import annotations

import time

import numpy as np

import saltus

try:
    import mujoco
except ImportError:
    mujoco = None

LIFTED = 0.3  # [rad] first ball

# MuJoCo's contacts are springs: direct stiffness without damping is its elastic setting. Small
# impedances keep the springs of the middle ball's two contacts apart, so that energy is kept; an
# impedance that rises with depth hardens them, so that the contacts act one after the other. This
# is the best of two dozen settings (also RK4, implicitfast, stiffness 1e5 to 1e10) that were tried
# for the smallest errors of energy and of the middle ball at this cost.
MUJOCO_STEP = 2e-5  # [s]
MUJOCO_SETTING = "Euler, dt 2e-5, solref -3e8 0, solimp .0001 .05 .001 .5 4"
MUJOCO_CRADLE = """<mujoco><option timestep="2e-5"/><worldbody>{balls}</worldbody></mujoco>"""
MUJOCO_BALL = """<body pos="{x} 0 1"><joint axis="0 1 0"/><joint axis="1 0 0"/>
<inertial pos="0 0 -1" mass="1" diaginertia="0.001 0.001 0.001"/>
<geom type="sphere" size="0.05" pos="0 0 -1" condim="1" solref="-3e8 0"
 solimp="0.0001 0.05 0.001 0.5 4"/></body>"""


def saltus_run(duration: float, h: float = 0.01) -> dict:
    model = saltus.load_urdf(saltus.scenes.cradle(3))
    start, cpu = time.perf_counter(), time.thread_time()
    run = saltus.simulate(model, q={"swing_0": LIFTED}, duration=duration, h=h, progress=False)
    wall, cpu = time.perf_counter() - start, time.thread_time() - cpu
    middle = [model.coordinate(name) for name in ("swing_1", "sway_1")]
    return {
        "engine": f"saltus, h = {h}",
        "duration": duration,
        "wall": wall / duration,
        "cpu": cpu / duration,
        "energy_error": run.energy_error,
        "resting_ball": float(np.abs(run.q[:, middle]).max()),
        "impacts": len(run.impacts),
    }


def mujoco_run(duration: float) -> dict | None:
    if mujoco is None:
        return None
    balls = "".join(MUJOCO_BALL.format(x=0.1 * (i - 1)) for i in range(3))
    model = mujoco.MjModel.from_xml_string(MUJOCO_CRADLE.format(balls=balls))
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    data = mujoco.MjData(model)
    data.qpos[0] = LIFTED
    mujoco.mj_forward(model, data)
    energies, kinetic, largest = [data.energy.sum()], 0.0, 0.0
    chunk = 50  # 1 ms between looks
    start, cpu = time.perf_counter(), time.thread_time()
    for _ in range(round(duration / MUJOCO_STEP / chunk)):
        mujoco.mj_step(model, data, nstep=chunk)
        kinetic = max(kinetic, data.energy[1])
        energies.append(data.energy.sum())
        largest = max(largest, abs(data.qpos[2]), abs(data.qpos[3]))
    wall, cpu = time.perf_counter() - start, time.thread_time() - cpu
    # The energy of pressed contacts is not in data.energy: only looks between impacts count.
    last = np.median(energies[-1000:])
    return {
        "engine": f"MuJoCo {mujoco.__version__}, {MUJOCO_SETTING}",
        "duration": duration,
        "wall": wall / duration,
        "cpu": cpu / duration,
        "energy_error": float(abs(last - energies[0]) / max(kinetic, 1e-300)),
        "resting_ball": float(largest),
    }
