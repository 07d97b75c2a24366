"""Motors, servos, damping, springs and forces, against reference values and closed forms."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import saltus
from saltus import BodyInertia, JointType, ModelBuilder, Pose

GOLDEN = json.loads((Path(__file__).parents[1] / "data" / "forces.json").read_text())
H = 0.01


def pendulum(**joint: float) -> ModelBuilder:
    """Return a point mass 1 at (0, -1) of a joint about z; gravity pulls along -y."""
    builder = ModelBuilder("pendulum").set_gravity((0, -9.81, 0))
    builder.add_link("bob", BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
    return builder.add_joint(
        "swing", JointType.revolute, parent="world", child="bob", axis=(0, 0, 1), **joint
    )


def arm() -> ModelBuilder:
    """Return the arm of two joints of the reference values, without motors."""
    builder = ModelBuilder("arm").set_gravity((0, -9.81, 0))
    builder.add_link("upper", BodyInertia(2, (0.5, 0, 0), np.diag([0, 0.17, 0.17])))
    builder.add_link("lower", BodyInertia(1, (0.4, 0, 0), np.diag([0, 0.06, 0.06])))
    revolute = JointType.revolute
    builder.add_joint(
        "shoulder", revolute, parent="world", child="upper", axis=(0, 0, 1), damping=0.1
    )
    return builder.add_joint(
        "elbow",
        revolute,
        parent="upper",
        child="lower",
        axis=(0, 0, 1),
        X_PJ=Pose((1, 0, 0)),
        damping=0.1,
    )


def servo_arm() -> saltus.Model:
    builder = arm()
    builder.add_position_servo("shoulder", joint="shoulder", kp=300, kd=40, effort=60)
    builder.add_position_servo("elbow", joint="elbow", kp=120, kd=12, effort=15)
    return builder.build()


def assert_rows(run: saltus.Trajectory, rows: list[dict], tolerance: float = 1e-12) -> None:
    for row in rows:
        k = round(row["t"] / H)
        for name in ("q", "p", "v"):
            np.testing.assert_allclose(
                getattr(run, name)[k], row[name], rtol=0, atol=tolerance, err_msg=f"{name} at {k}"
            )


def test_a_driven_pendulum_is_the_reference() -> None:
    builder = pendulum(damping=0.2).add_motor("motor", joint="swing")
    model = builder.build()

    def policy(now: saltus.Moment) -> dict[str, float]:
        return {"motor": 1.5 * math.sin(2 * (now.t + H / 2))}  # in the middle of the step

    run = saltus.simulate(model, q=[1.0], duration=5.0, h=H, control=policy)
    expected = GOLDEN["driven"]
    assert_rows(run, expected["rows"])
    work = run.work["motor"][-1] + run.work["damping"][-1]
    assert work == pytest.approx(expected["work"], abs=1e-11)
    energy = run.total[-1] - run.total[0]
    assert energy == pytest.approx(expected["energy_change"], abs=1e-11)
    # the work is that of the midpoint rule: H - H_0 - W is O(h^2) and does not grow
    assert run.energy_error < 1e-4


def test_servos_with_limits_are_the_reference() -> None:
    run = saltus.simulate(
        servo_arm(),
        q=[-1.2, 0.2],
        duration=1.0,
        h=H,
        control={"shoulder": 1.0, "elbow": -0.8},
    )
    assert_rows(run, GOLDEN["servo"]["rows"])


def test_an_array_of_controls_is_told_row_by_row() -> None:
    model = pendulum().add_motor("motor", joint="swing").build()
    rows = np.array([[1.0], [2.0], [3.0]])
    run = saltus.simulate(model, duration=5 * H, h=H, control=rows)
    np.testing.assert_array_equal(run.control[:, 0], [1, 2, 3, 3, 3, 3])
    asked = iter(rows)
    same = saltus.simulate(model, duration=5 * H, h=H, control=lambda now: next(asked, None))
    np.testing.assert_array_equal(run.q, same.q)


def test_a_policy_is_asked_every_so_many_steps_and_sees_the_run() -> None:
    model = pendulum().add_motor("motor", joint="swing").build()
    seen = []

    def policy(now: saltus.Moment) -> None:
        seen.append((now.t, now.q.copy(), now.v.copy(), now.u.copy()))

    run = saltus.simulate(model, q=[0.5], duration=10 * H, h=H, control=policy, control_every=3)
    assert [round(t / H) for t, *_ in seen] == [0, 3, 6, 9]
    np.testing.assert_array_equal(seen[2][1], run.q[6])
    np.testing.assert_array_equal(seen[2][2], run.v[6])


def test_damping_multiplies_by_the_factor_of_the_midpoint_rule() -> None:
    builder = ModelBuilder("slide").set_gravity((0, 0, 0))
    builder.add_body("cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic")
    model = builder.set_damping("cart", 6.0).build()
    run = saltus.simulate(model, v=[1.0], duration=1.0, h=H)
    z = H * 6.0 / 2.0
    factor = (1 - z / 2) / (1 + z / 2)
    np.testing.assert_allclose(run.v[:, 0], factor ** np.arange(101), rtol=1e-13)
    # what is lost is what damping took
    np.testing.assert_allclose(run.total - run.total[0], run.work["damping"], atol=1e-15)


def test_a_spring_swings_by_the_phase_of_the_midpoint_rule() -> None:
    builder = ModelBuilder("spring").set_gravity((0, 0, 0))
    builder.add_body("cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic")
    model = builder.add_joint_spring("cart", stiffness=50.0, rest=0.3).build()
    run = saltus.simulate(model, q=[0.5], duration=2.0, h=H)
    phase = 2 * math.atan(H * 5.0 / 2) * np.arange(201)  # omega = 5 rad/s
    np.testing.assert_allclose(run.q[:, 0], 0.3 + 0.2 * np.cos(phase), atol=1e-13)
    # H is quadratic: conserved to rounding, and the spring's part is in it
    assert run.potential[0] == pytest.approx(0.5 * 50 * 0.2**2, rel=1e-14)
    assert run.energy_error < 1e-13


def test_an_armature_is_inertia_of_the_joint() -> None:
    plain, heavy = pendulum().build(), pendulum().set_armature("swing", 0.5).build()
    assert plain.mass_matrix([0.0])[0, 0] == pytest.approx(1.0)
    assert heavy.mass_matrix([0.0])[0, 0] == pytest.approx(1.5)
    run = saltus.simulate(heavy, q=[1.0], duration=2.0, h=H)
    # a pendulum of inertia 1.5 m l^2: the same equation with g / 1.5
    slow = pendulum().set_gravity((0, -9.81 / 1.5, 0)).build()
    np.testing.assert_allclose(
        run.q, saltus.simulate(slow, q=[1.0], duration=2.0, h=H).q, atol=1e-12
    )


def test_partials_of_the_lagrangian_hold_armature_and_spring() -> None:
    builder = arm().set_armature("elbow", 0.3)
    builder.add_joint_spring("shoulder", stiffness=7.0, rest=-0.2)
    model = builder.build()
    q, v = np.array([0.4, -0.9]), np.array([1.1, -0.7])
    L = model.lagrangian(q, v)
    step = 1e-6
    for i in range(2):
        d = step * np.eye(2)[i]
        slope_q = (model.lagrangian(q + d, v).value - model.lagrangian(q - d, v).value) / (2 * step)
        slope_v = (model.lagrangian(q, v + d).value - model.lagrangian(q, v - d).value) / (2 * step)
        # 1e-8: central differences with 1e-6 of numbers of size 10
        assert L.L_q[i] == pytest.approx(slope_q, abs=1e-8)
        assert L.L_v[i] == pytest.approx(slope_v, abs=1e-8)
        column_q = (model.lagrangian(q + d, v).L_q - model.lagrangian(q - d, v).L_q) / (2 * step)
        column_v = (model.lagrangian(q, v + d).L_v - model.lagrangian(q, v - d).L_v) / (2 * step)
        np.testing.assert_allclose(L.L_qq[:, i], column_q, atol=1e-7)
        np.testing.assert_allclose(L.L_vv[:, i], column_v, atol=1e-7)


def test_an_actuator_over_two_joints_is_solved_exactly() -> None:
    """A stiff spring between two joints as an actuator: Newton's matrix has its rank-one term."""
    builder = arm()
    builder.add_actuator(
        "belt", joints={"shoulder": 1.0, "elbow": 1.0}, gain=1e5, bias=(0, -1e5, -50)
    )
    model = builder.build()
    stepper = saltus.Stepper(model, h=H)
    state = model.state([0.3, -0.3])
    for _ in range(100):
        state = stepper.advance(state, control={"belt": 0.0})
        assert stepper.report.iterations <= 6  # quadratic: without the term it would not converge
    assert abs(state.q.sum()) < 1e-3


@pytest.mark.parametrize("kp", [1e2, 1e4, 1e6])
def test_stiff_servos_with_little_effort_converge(kp: float) -> None:
    builder = arm()
    for joint in ("shoulder", "elbow"):
        builder.add_position_servo(joint, joint=joint, kp=kp, kd=kp / 50, effort=20.0)
    run = saltus.simulate(
        builder.build(),
        q=[-1.2, 0.2],
        duration=2.0,
        h=H,
        control={"shoulder": -0.5, "elbow": 0.3},
    )
    assert run.complete
    assert run.residual < 1e-11


def test_the_effort_of_a_joint_limits_the_sum_of_its_actuators() -> None:
    builder = pendulum(effort=3.0).set_gravity((0, 0, 0))
    builder.add_motor("a", joint="swing").add_motor("b", joint="swing")
    model = builder.build()
    run = saltus.simulate(model, duration=0.1, h=H, control={"a": 4.0, "b": 2.0})
    assert run.p[-1, 0] == pytest.approx(0.3, rel=1e-12)  # 3 N m over 0.1 s
    # each keeps its share of the work
    assert run.work["a"][-1] == pytest.approx(2 * run.work["b"][-1], rel=1e-12)


def test_a_gear_turns_the_torque_of_the_motor_into_that_of_the_joint() -> None:
    builder = pendulum().set_gravity((0, 0, 0)).add_motor("m", joint="swing", gear=50, effort=0.1)
    model = builder.build()
    np.testing.assert_array_equal(model.control_limits, [[-0.1, 0.1]])
    run = saltus.simulate(model, duration=0.1, h=H, control={"m": 1.0})
    assert run.p[-1, 0] == pytest.approx(50 * 0.1 * 0.1, rel=1e-12)


def test_a_force_on_a_free_body_is_momentum() -> None:
    builder = ModelBuilder("ball").set_gravity((0, 0, 0))
    builder.add_body("ball", saltus.Sphere(0.1), mass=2.0)
    model = builder.build()
    push = saltus.Wrench((3.0, 0, 0), (0, 0, 0.5))
    run = saltus.simulate(model, duration=1.0, h=H, forces={"ball": push})
    np.testing.assert_allclose(run.p[-1], [3, 0, 0, 0, 0, 0.5], atol=1e-12)
    # 1/2 p^2 / m, 1/2 L^2 / I: all of it is work
    assert run.work["applied"][-1] == pytest.approx(run.kinetic[-1], rel=1e-10)


def test_a_force_at_a_point_is_the_gradient_of_its_potential() -> None:
    """A force -m g e_y at the bob's centre is gravity: the same motion, by another way."""
    model = pendulum().build()
    run = saltus.simulate(model, q=[1.0], duration=2.0, h=H)
    free = pendulum().set_gravity((0, 0, 0)).build()
    pull = saltus.Wrench((0, -9.81, 0), point=(0, -1, 0))
    same = saltus.simulate(free, q=[1.0], duration=2.0, h=H, forces={"bob": pull})
    np.testing.assert_allclose(run.q, same.q, atol=1e-12)


def test_a_force_in_the_axes_of_the_body_turns_with_it() -> None:
    builder = ModelBuilder("rocket").set_gravity((0, 0, 0))
    builder.add_body("rocket", saltus.Box((0.1, 0.1, 0.5)), mass=1.0)
    model = builder.build()
    thrust = saltus.Wrench((0, 0, 2.0), frame="body")
    state = model.state({"rocket_qy": math.sin(math.pi / 4), "rocket_qw": math.cos(math.pi / 4)})
    run = saltus.simulate(model, state=state, duration=1.0, h=H, forces={"rocket": thrust})
    np.testing.assert_allclose(run.p[-1, :3], [2, 0, 0], atol=1e-12)  # z of the body is x


def test_forced_motion_is_of_second_order() -> None:
    builder = arm()  # soft servos: the order shows where h is small against their time constants
    builder.add_position_servo("shoulder", joint="shoulder", kp=30, kd=4)
    builder.add_position_servo("elbow", joint="elbow", kp=12, kd=1)
    model = builder.build()
    ends = []
    for h in (0.005, 0.0025, 0.00125):
        run = saltus.simulate(
            model, q=[0.2, -0.1], duration=0.5, h=h, control={"shoulder": 0.3, "elbow": 0.1}
        )
        ends.append(run.q[-1])
    ratio = np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(ends[1] - ends[2])
    assert 3.5 < ratio < 4.5  # 4 of order 2


def test_damping_of_a_ball_joint_slows_its_turning() -> None:
    builder = ModelBuilder("top").set_gravity((0, 0, 0))
    builder.add_body("top", saltus.Sphere(0.5), mass=1.0, joint="spherical")
    model = builder.set_damping("top", 0.2).build()
    run = saltus.simulate(model, v=[1.0, 2.0, -1.0], duration=1.0, h=H)
    inertia = 0.4 * 0.25
    z = H * 0.2 / inertia
    factor = ((1 - z / 2) / (1 + z / 2)) ** 100
    np.testing.assert_allclose(run.v[-1], factor * np.array([1.0, 2.0, -1.0]), rtol=1e-11)


def test_the_energy_of_a_ball_jointed_chain_balances() -> None:
    builder = ModelBuilder("chain")
    for k in range(3):
        builder.add_body(
            f"link_{k}",
            saltus.Capsule(0.02, 0.3),
            mass=0.5,
            X=Pose((0, 0, -0.2)),
            joint="spherical",
            parent="world" if k == 0 else f"link_{k - 1}",
        )
        builder.set_damping(f"link_{k}", 0.02)
    model = builder.build()
    run = saltus.simulate(
        model, v={"link_0": (0.5, 3.0, 0)}, duration=2.0, h=0.005, collisions=False
    )
    assert run.work["damping"][-1] < -0.01
    assert run.energy_error < 2e-3  # O(h^2) of the midpoint rule
