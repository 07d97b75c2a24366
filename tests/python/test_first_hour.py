"""A newcomer's first hour with a robot, task by task, as one would type it.

Read from the top: each function is one task, and its assertions are what one would see.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import saltus

# test_second_hour.py goes on: states by name, sensors in policies, springs, closed chains.
ARM = Path(__file__).parents[1] / "data" / "arm.urdf"  # two links, a hand, a box as its base
TIP = (0.0, 0.0, 0.3)  # in the hand's frame


@pytest.fixture
def arm() -> saltus.Model:
    return saltus.load_urdf(ARM)


def box_on_floor(friction: float = 0.5) -> saltus.Model:
    scene = saltus.ModelBuilder("scene").add_floor(restitution=0, friction=friction)
    scene.add_body("box", saltus.Box((0.3, 0.2, 0.1)), mass=1.0, X=saltus.Pose((0, 0, 0.1)))
    return scene.build()


def test_load_and_print(arm):
    assert (
        str(arm)
        == """\
arm: 2 coordinates, 1 pair, 3 kg
base, 1 box
  shoulder (revolute about y, -2 to 2 rad): upper, 2 kg
    elbow (revolute about y, -2.6 to 2.6 rad): hand, 1 kg, 1 sphere"""
    )
    hand, elbow = arm.link("hand"), arm.joint("elbow")
    assert (hand.mass, elbow.parent, elbow.child) == (1.0, "upper", "hand")
    np.testing.assert_array_equal(hand.inertia.c_J, (0, 0, 0.15))
    np.testing.assert_array_equal(elbow.axis, (0, 1, 0))
    np.testing.assert_array_equal(elbow.X_PJ.p, (0, 0, 0.4))


def test_set_and_read_by_name(arm):
    state = arm.state(q={"elbow": 0.3}, v={"shoulder": 1.0})
    assert state.q[arm.coordinate("elbow")] == 0.3
    assert arm.velocity(state)[arm.velocity_index("shoulder")] == pytest.approx(1.0)
    with pytest.raises(saltus.ModelError, match='no coordinate "elbw"; there are shoulder, elbow'):
        arm.state(q={"elbw": 0.3})
    with pytest.raises(saltus.ModelError, match='no joint "elbw"; there are shoulder, elbow'):
        arm.joint("elbw")


def test_where_is_the_hand(arm):
    pose = arm.pose({"shoulder": np.pi / 2}, "hand")
    np.testing.assert_allclose(pose.p, (0.4, 0, 0.1), atol=1e-15)  # upright before, now forwards
    np.testing.assert_allclose(pose * TIP, (0.7, 0, 0.1), atol=1e-15)


def test_jacobian(arm):
    J = arm.jacobian({"shoulder": np.pi / 2}, "hand", TIP)  # dp/dt = J v
    np.testing.assert_allclose(J, [[0, 0], [0, 0], [-0.7, -0.3]], atol=1e-15)
    # a force of 10 N upwards at the tip, as torques of the joints
    np.testing.assert_allclose(J.T @ (0, 0, 10), (-7, -3), atol=1e-14)


def test_forward_dynamics(arm):
    upright = arm.accelerations(None)  # balanced on the tip of a needle
    np.testing.assert_allclose(upright, 0, atol=1e-12)
    falling = arm.accelerations({"shoulder": 0.1})
    assert falling[0] > 0  # further down
    pushed = arm.accelerations(None, None, {"shoulder": 2.0})
    np.testing.assert_allclose(arm.mass_matrix(None) @ pushed, (2, 0), atol=1e-12)


def test_inverse_dynamics(arm):
    q, v, a = {"elbow": 0.5}, {"shoulder": 1.0}, {"elbow": 3.0}
    torques = arm.inverse_dynamics(q, v, a)
    np.testing.assert_allclose(arm.accelerations(q, v, torques), (0, 3), atol=1e-12)


def test_gravity_compensation(arm):
    q = {"shoulder": np.pi / 2}
    hold = -arm.gravity_forces(q)
    # upper: 2 kg at 0.2 m, hand: 1 kg at 0.55 m, which turn the arm down, by a positive angle
    np.testing.assert_allclose(hold, (-9.81 * (2 * 0.2 + 0.55), -9.81 * 0.15))
    np.testing.assert_allclose(arm.accelerations(q, None, hold), 0, atol=1e-12)


def driven_arm() -> saltus.Model:
    builder = saltus.read_urdf(ARM)
    builder.add_motor("shoulder", joint="shoulder").add_motor("elbow", joint="elbow")
    return builder.build()


def test_motors_hold_it_still():
    arm = driven_arm()
    start = {"shoulder": 1.0, "elbow": 0.5}
    run = saltus.simulate(arm, start, duration=1.0, control=lambda now: -arm.gravity_forces(now.q))
    assert np.abs(run.q - run.q[0]).max() < 1e-9


def test_pd_control():
    arm, goal = driven_arm(), np.array((0.5, 1.0))
    kp, kd = np.array((200, 50)), np.array((20, 3))

    def policy(now):  # asked before each step
        return kp * (goal - now.q) - kd * now.v - arm.gravity_forces(now.q)

    run = saltus.simulate(arm, duration=3.0, h=0.001, control=policy)
    np.testing.assert_allclose(run.q[-1], goal, atol=1e-3)


def test_servo():
    builder = saltus.read_urdf(ARM)
    builder.add_position_servo("elbow", joint="elbow", kp=200, kd=20)
    run = saltus.simulate(builder.build(), duration=3.0, control={"elbow": 1.0})
    sag = 1.0 - run.column("elbow")[-1]  # a spring to the goal: it gives way under the hand
    assert 0 < abs(sag) < 9.81 * 0.15 / 200 * 1.1


def test_contact_forces():
    run = saltus.simulate(box_on_floor(), duration=0.1, h=0.01, record_contacts=True)
    impulse = run.contacts["lambda"].sum()
    assert impulse == pytest.approx(9.81 * 0.1)  # the weight of 1 kg for 0.1 s


def test_a_loop_of_ones_own():
    arm = saltus.load_urdf(ARM, effects="none")  # the elbow may turn on and on
    stepper = saltus.Stepper(arm, h=0.01)
    state = arm.state(q={"shoulder": 0.5})
    start = saltus.energies(arm, state, 0.01)
    while state.t < 0.499:
        state = stepper.advance(state)
    end = saltus.energies(arm, state, 0.01)
    assert end.kinetic > 0.1
    assert end.kinetic + end.potential == pytest.approx(start.potential, abs=0.05)
    assert stepper.report.residual < 1e-10


def test_reset(arm):
    stepper = saltus.Stepper(arm, h=0.01)
    start = arm.state(q={"shoulder": 0.5})  # a value: keep it, and go on from it again
    first, again = stepper.advance(start), stepper.advance(start)
    np.testing.assert_allclose(first.q, again.q, atol=1e-12)


def test_record(arm):
    stepper, states = saltus.Stepper(arm, h=0.01), [arm.state(q={"shoulder": 0.5})]
    for _ in range(20):
        states.append(stepper.advance(states[-1]))
    t, q, p = (np.array([getattr(s, name) for s in states]) for name in ("t", "q", "p"))
    run = saltus.Trajectory.from_states(arm, t, q, p=p)
    same = saltus.simulate(arm, q={"shoulder": 0.5}, duration=0.2, h=0.01)
    np.testing.assert_allclose(run.q, same.q, atol=1e-12)
    np.testing.assert_allclose(run.total, same.total, atol=1e-12)


def test_plot(arm, tmp_path):
    pytest.importorskip("matplotlib", reason="pip install 'saltus[demo]'")
    run = saltus.simulate(arm, q={"shoulder": 0.5}, duration=0.2)
    run.plot(tmp_path / "arm.png")
    assert (tmp_path / "arm.png").stat().st_size > 1000


def test_batch(arm):
    angles = np.linspace(0.1, 0.5, 5)
    batch = saltus.simulate_batch(arm, q={"shoulder": angles}, duration=0.2)
    assert batch.q.shape == (5, 21, 2)
    np.testing.assert_array_equal(batch.q[:, 0, 0], angles)
    assert "5 runs" in repr(batch)


def test_save_and_load(arm, tmp_path):
    run = saltus.simulate(arm, q={"shoulder": 0.5}, duration=0.2)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    np.testing.assert_array_equal(again.q, run.q)
    assert again.model.joint_names == ["shoulder", "elbow"]


def test_two_robots_in_a_scene(arm):
    scene = saltus.ModelBuilder("scene").add_floor("floor")
    scene.add(arm, "left_").add(arm, "right_", X=saltus.Pose((2, 0, 0)))
    both = scene.build()
    assert both.coordinate_names == ["left_shoulder", "left_elbow", "right_shoulder", "right_elbow"]
    tip = both.pose({"right_shoulder": np.pi / 2}, "right_hand") * TIP
    np.testing.assert_allclose(tip, (2.7, 0, 0.1), atol=1e-15)


def test_change_a_mass(arm):
    builder = arm.builder()  # or saltus.read_urdf(file)
    builder.link("hand").mass = 3.0
    heavy = builder.build()
    assert heavy.link("hand").mass == 3.0
    assert arm.link("hand").mass == 1.0  # models do not change
    q = {"shoulder": np.pi / 2}
    more = heavy.gravity_forces(q) - arm.gravity_forces(q)
    np.testing.assert_allclose(more, (9.81 * 2 * 0.55, 9.81 * 2 * 0.15))


def test_change_friction():
    push = {"box": ((1, 0, 0), (0, 0, 0))}  # it slides at 1 m/s
    for friction in (0.1, 0.5):
        run = saltus.simulate(box_on_floor(friction), v=push, duration=1.5, h=0.01)
        way = run.poses("box")[-1, 0, 3]
        assert way == pytest.approx(1 / (2 * friction * 9.81), rel=0.05)  # v^2 / 2 mu g
    builder = box_on_floor().builder().set_contact("box", "floor", restitution=0, friction=0.1)
    builder.link("box").material = "box"
    icy = builder.build()
    assert icy.contact_properties(0).friction == 0.1


def test_limits(arm):
    elbow = arm.joint("elbow")
    assert (elbow.lower, elbow.upper) == (-2.6, 2.6)
    builder = arm.builder()
    builder.joint("elbow").upper = 1.0
    assert builder.build().joint("elbow").upper == 1.0
    with pytest.raises(saltus.ModelError, match='joint "elbow"'):
        builder.joint("elbow").lower = 5.0  # above the upper one
    assert builder.joint("elbow").lower == -2.6
    run = saltus.simulate(arm, q={"shoulder": 0.5}, duration=3.0)  # it falls onto its stop
    assert run.q[:, 0].max() == pytest.approx(2.0, abs=1e-9)
    free = saltus.load_urdf(ARM, effects="none")
    assert saltus.simulate(free, q={"shoulder": 0.5}, duration=3.0).q[:, 0].max() > 2.5


def test_sensors():
    builder = saltus.read_urdf(ARM).add_sensor("gyro", "gyro", link="hand")
    builder.add_sensor("tip", "framepos", link="hand", X=saltus.Pose(TIP))
    arm = builder.add_sensor("imu", "accelerometer", link="hand").build()
    run = saltus.simulate(arm, q={"shoulder": 0.5}, duration=0.3, h=0.001)
    gyro = run.sensor("gyro")  # rad/s
    np.testing.assert_allclose(gyro[:, 1], run.v.sum(axis=1), atol=1e-12)  # both axes are y
    np.testing.assert_allclose(run.sensor("tip")[-1], arm.pose(run.q[-1], "hand") * TIP, atol=1e-12)
    assert run.sensor("imu").shape == (len(run), 3)  # m/s^2, less gravity


def test_centre_of_mass(arm):
    com = arm.centre_of_mass(None)
    np.testing.assert_allclose(com, (0, 0, 0.1 + (2 * 0.2 + 0.55) / 3), atol=1e-15)
    run = saltus.simulate(arm, q={"shoulder": 0.5}, duration=0.2)
    path, momentum = arm.centre_of_mass(run.q), arm.momentum(run.q, run.v)
    assert path.shape == (len(run), 3)
    assert momentum.shape == (len(run), 6)  # [angular; linear]
    np.testing.assert_allclose(run.potential, 3 * 9.81 * path[:, 2], atol=1e-12)


def test_random_valid_configurations():
    arm = saltus.load_urdf(ARM, floor=True)
    rng = np.random.default_rng(7)
    drawn = np.array([arm.random_configuration(rng) for _ in range(100)])
    assert np.abs(drawn[:, 0]).max() < 2.0  # within the limits
    free = [q for q in drawn if (arm.gaps(q).phi > 0).all()]  # and the hand above the floor
    assert 10 < len(free) < 100


def test_inverse_kinematics(arm):
    target = np.array([0.3, 0.0, 0.5])
    frames = arm.at()  # one place for the kinematics, moved along

    def error(q):
        return frames.set(q).pose("hand") * TIP - target

    def slope(q):
        return frames.set(q).jacobian("hand", TIP)

    bounds = np.array([(joint.lower, joint.upper) for joint in arm.joints]).T
    found = least_squares(error, x0=(0.3, 0.6), jac=slope, bounds=bounds, xtol=1e-15)
    np.testing.assert_allclose(arm.pose(found.x, "hand") * TIP, target, atol=1e-9)


def test_quaternions():
    model = box_on_floor()
    tilted = Rotation.from_euler("x", 30, degrees=True)
    q = model.state(q={"box": tilted}).q
    assert model.n_q == model.n_v + 1  # x y z, then a unit quaternion x y z w
    np.testing.assert_allclose(q[3:], tilted.as_quat(), atol=1e-15)
    np.testing.assert_allclose(model.pose(q, "box").R, tilted.as_matrix(), atol=1e-15)
    turned = model.integrate(q, {"box_wz": np.pi / 2})  # about the world's z
    expected = Rotation.from_euler("z", 90, degrees=True) * tilted
    np.testing.assert_allclose(model.pose(turned, "box").R, expected.as_matrix(), atol=1e-15)


def test_drop_a_box():
    run = saltus.simulate(box_on_floor(), q={"box_z": 0.5}, duration=1.0)
    assert run.impacts["t"][0] == pytest.approx(np.sqrt(2 * 0.5 / 9.81))
    assert run.poses("box")[-1, 2, 3] == pytest.approx(0.1, abs=1e-9)
