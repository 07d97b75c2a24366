"""A newcomer's second hour, after test_first_hour.py: what one adds to the robot of a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import saltus

ARM = Path(__file__).parents[1] / "data" / "arm.urdf"  # two links, a hand, a box as its base
TIP = (0.0, 0.0, 0.3)  # in the hand's frame


def test_named_states():
    builder = saltus.read_urdf(ARM).add_state("ready", q={"shoulder": 0.5, "elbow": 1.0})
    arm = builder.build()
    assert arm.state_names == ["ready"]
    np.testing.assert_array_equal(arm.state("ready").q, (0.5, 1.0))
    run = saltus.simulate(arm, "ready", duration=0.1)
    np.testing.assert_array_equal(run.q[0], (0.5, 1.0))
    np.testing.assert_array_equal(arm.pose("ready", "hand").p, arm.pose(run.q[0], "hand").p)


def test_a_policy_reads_sensors():
    builder = saltus.read_urdf(ARM).add_motor("elbow", joint="elbow")
    builder.add_sensor("rate", "jointvel", joint="elbow")
    arm = builder.build()

    def brake(now):
        return {"elbow": -2 * now.sensors["rate"]}

    slow = saltus.simulate(arm, {"elbow": 1.0}, duration=0.5, control=brake)
    free = saltus.simulate(arm, {"elbow": 1.0}, duration=0.5)
    assert np.ptp(slow.column("elbow")) < np.ptp(free.column("elbow"))
    assert slow.work["elbow"][-1] < 0  # a brake takes energy


def test_springs():
    builder = saltus.read_urdf(ARM)
    builder.add_joint_spring("shoulder", stiffness=100).add_joint_spring("elbow", stiffness=50)
    soft = builder.set_damping("shoulder", 10).set_damping("elbow", 5).build()
    run = saltus.simulate(soft, {"shoulder": 0.5}, duration=5.0)
    np.testing.assert_allclose(run.q[-1], 0, atol=1e-6)  # stiffer than gravity: it stands up
    lost = run.total[0] - run.total[-1]
    assert -run.work["damping"][-1] == pytest.approx(lost, rel=1e-3)  # O(h^2)


def test_a_closed_chain():
    builder = saltus.read_urdf(ARM)
    table = saltus.At("base", (0, 0, 0.4))  # its z axis is normal to the plane
    builder.add_loop("slides", "on_plane", a=saltus.At("hand", TIP), b=table)
    arm = builder.build()
    start = saltus.close_loops(arm, q={"shoulder": 0.3, "elbow": 1.0})
    np.testing.assert_allclose((arm.pose(start.q, "hand") * TIP)[2], 0.4, atol=1e-11)
    run = saltus.simulate(arm, state=start, duration=0.3)
    assert np.ptp(run.column("shoulder")) > 0.1  # it moves
    heights = [arm.loop_gaps(q)["slides"] for q in run.q]
    np.testing.assert_allclose(heights, 0, atol=1e-11)  # and stays on the plane
    assert run.energy_error < 1e-3  # a loop does no work: O(h^2)


def test_a_joint_that_moves_as_it_is_told():
    builder = saltus.read_urdf(ARM)
    builder.set_prescribed("shoulder", [0.0, 0.5, 1.0], [0.0, 0.4, 0.0])
    arm = builder.build()
    run = saltus.simulate(arm, state=saltus.close_loops(arm), duration=1.0)
    np.testing.assert_allclose(run.column("shoulder")[[0, 50, 100]], (0, 0.4, 0), atol=1e-12)
    assert abs(run.work["applied"][-1]) > 0  # by what moves it
