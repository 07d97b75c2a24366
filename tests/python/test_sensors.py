"""Sensors against closed forms, and against what runs and models give otherwise."""

from __future__ import annotations

import re

import numpy as np
import pytest
from scenes import puck, thrown
from test_named_states import ARM

import saltus

G = 9.81
SITE = saltus.Pose((0.1, -0.2, 0.3), saltus.rotation_from_rpy(0.3, -0.5, 0.8))


def with_sensors(builder: saltus.ModelBuilder, link: str, **options: object) -> saltus.Model:
    """Return a model with a sensor of each kind that has a place, named after its kind."""
    for kind in ("framepos", "framequat", "framelinvel", "frameangvel"):
        builder.add_sensor(kind, kind, link=link, **options)
    for kind in ("velocimeter", "gyro", "accelerometer"):
        builder.add_sensor(kind, kind, link=link, **options)
    return builder.build()


def stone(**options: object) -> saltus.Model:
    builder = saltus.ModelBuilder().add_body("stone", saltus.Box((0.1, 0.2, 0.3)), mass=2.0)
    return with_sensors(builder, "stone", **options)


def test_a_falling_accelerometer_reads_nothing():
    run = saltus.simulate(stone(), v={"stone": (1, 2, 3, 0, 0, 0)}, duration=1.0)
    np.testing.assert_allclose(run.sensor("accelerometer")[1:], 0, atol=1e-10)
    np.testing.assert_allclose(run.sensor("accelerometer")[0], (0, 0, G))


def test_one_that_stands_reads_plus_g_upwards():
    model = thrown(saltus.Box((0.1, 0.1, 0.1)), restitution=0.0, friction=0.5)
    turn = saltus.rotation_from_rpy(0.3, 0.4, 0.5)
    model = model.builder().add_sensor(
        "imu", "accelerometer", link="body", X=saltus.Pose((0.05, 0, 0), turn)
    ).add_sensor("foot", "touch", link="body").build()  # fmt: skip
    run = saltus.simulate(
        model, {"body": saltus.Pose((0, 0, 0.1))}, duration=0.5, record_contacts=True
    )
    expected = np.tile(turn.T @ [0, 0, G], (len(run), 1))
    np.testing.assert_allclose(run.sensor("imu"), expected, atol=1e-9)
    np.testing.assert_allclose(run.sensor("foot")[1:], G, rtol=1e-9)


def pendulum(length: float = 0.7) -> saltus.Model:
    """Return a mass point on a rod: q = 0 hangs down, the sensor's z axis points to the pivot."""
    body = saltus.BodyInertia(1.0, (0, 0, -length), np.zeros((3, 3)))
    builder = saltus.ModelBuilder().add_link("bob", body)
    builder.add_joint("swing", "revolute", parent="world", child="bob", axis=(0, 1, 0))
    builder.add_sensor("swing", "jointpos", joint="swing")
    builder.add_sensor("rate", "jointvel", joint="swing")
    return with_sensors(builder, "bob", X=saltus.Pose((0, 0, -length)))


@pytest.mark.parametrize("h", [0.01, 0.005])
def test_a_pendulum_feels_its_rod_alone(h):
    """The rod pulls with g cos q + l q'^2, and nothing acts across it."""
    length = 0.7
    run = saltus.simulate(pendulum(length), q={"swing": 1.2}, duration=1.0, h=h)
    felt = run.sensor("accelerometer")[1:]
    q, v = ((x[1:, 0] + x[:-1, 0]) / 2 for x in (run.q, run.v))  # in the middle of steps
    pull = G * np.cos(q) + length * v**2
    error = np.abs(felt - np.stack([0 * q, 0 * q, pull], axis=1)).max()
    assert error < 60 * h**2  # of second order
    np.testing.assert_array_equal(run.sensor("swing"), run.q[:, 0])
    np.testing.assert_array_equal(run.sensor("rate"), run.v[:, 0])
    np.testing.assert_allclose(run.sensor("gyro")[:, 1], run.v[:, 0], atol=1e-15)
    np.testing.assert_allclose(run.sensor("velocimeter")[:, 0], -length * run.v[:, 0], atol=1e-14)


def test_frames_are_those_of_poses_and_velocities():
    rng = np.random.default_rng(3)
    model = stone(X=SITE)
    q = np.array([model.random_configuration(rng) for _ in range(200)])
    v = rng.normal(size=(200, 6))
    run = saltus.Trajectory.from_states(model, 0.1 * np.arange(200), q, v)
    site = np.eye(4)
    site[:3, :3], site[:3, 3] = SITE.R, SITE.p
    X = run.poses("stone") @ site
    R = X[:, :3, :3]
    np.testing.assert_allclose(run.sensor("framepos"), X[:, :3, 3], atol=1e-14)
    x, y, z, w = run.sensor("framequat").T
    assert (w >= 0).all()
    first = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], axis=1)
    third = np.stack([2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)], axis=1)
    np.testing.assert_allclose(first, R[:, :, 0], atol=1e-14)
    np.testing.assert_allclose(third, R[:, :, 2], atol=1e-14)
    J = model.jacobian(q, "stone", SITE.p)
    velocity = np.einsum("nij,nj->ni", J, v)
    np.testing.assert_allclose(run.sensor("framelinvel"), velocity, atol=1e-13)
    np.testing.assert_allclose(run.sensor("frameangvel"), v[:, 3:], atol=1e-14)
    across = np.einsum("nij,ni->nj", R, velocity)
    np.testing.assert_allclose(run.sensor("velocimeter"), across, atol=1e-13)
    turning = np.einsum("nij,ni->nj", R, v[:, 3:])
    np.testing.assert_allclose(run.sensor("gyro"), turning, atol=1e-13)


def test_half_turns_have_quaternions():
    model = stone()
    q = np.array([[0, 0, 0, *axis, 0] for axis in np.eye(3)])
    run = saltus.Trajectory.from_states(model, np.arange(3.0), q)
    np.testing.assert_allclose(np.abs(run.sensor("framequat")), np.eye(4)[:3], atol=1e-15)


def test_joints_that_mimic_and_joints_of_several():
    builder = saltus.read_urdf(ARM).add_sensor("f", "jointpos", joint="other_finger")
    run = saltus.simulate(builder.build(), q={"finger": 0.03}, duration=0.1)
    np.testing.assert_array_equal(run.sensor("f"), run.column("finger"))
    builder = stone().builder().add_sensor("all", "jointpos", joint="stone")
    run = saltus.simulate(builder.build(), duration=0.1)
    np.testing.assert_array_equal(run.sensor("all"), run.q)


def sliding() -> saltus.Model:
    """Return a puck that slides on the floor."""
    builder = puck(restitution=0.0, friction=0.2).builder()
    builder.add_sensor("touch", "touch", link="puck").add_sensor("f", "contactforce", link="puck")
    builder.add_sensor("floor", "contactforce", link="world", other="puck")
    builder.add_sensor("with floor", "touch", link="puck", other="floor")
    return builder.add_sensor("imu", "accelerometer", link="puck").build()


@pytest.mark.parametrize("record_every", [1, 4])
def test_contact_forces_are_weight_and_friction(record_every):
    run = saltus.simulate(
        sliding(), v={"x": 5.0}, duration=0.4, record_contacts=True, record_every=record_every
    )
    expected = np.tile([-0.2 * G, 0, G], (len(run) - 1, 1))
    np.testing.assert_allclose(run.sensor("f")[1:], expected, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(run.sensor("floor"), -run.sensor("f"), atol=1e-12)
    np.testing.assert_allclose(run.sensor("touch")[1:], G, rtol=1e-9)
    np.testing.assert_array_equal(run.sensor("with floor"), run.sensor("touch"))
    assert (run.sensor("f")[0] == 0).all()
    # what touches it is all that it feels: m (a - g) = f
    np.testing.assert_allclose(run.sensor("imu")[1:], expected, atol=1e-8)


def test_impacts_are_in_the_mean():
    """A ball that falls and bounces: momentum by time is the force, gravity aside."""
    builder = puck(restitution=0.8).builder().add_sensor("f", "contactforce", link="puck")
    run = saltus.simulate(
        builder.build(), q={"z": 0.3}, duration=1.0, record_contacts=True, record_every=3
    )
    assert len(run.impacts) > 0
    change = np.diff(run.column("z", "p")) / np.diff(run.t)
    np.testing.assert_allclose(run.sensor("f")[1:, 2], change + G, atol=1e-9)


def test_forces_that_were_not_recorded():
    run = saltus.simulate(sliding(), duration=0.1)
    with pytest.raises(saltus.ModelError, match="record_contacts=True"):
        run.sensor("touch")
    assert run.sensor("imu").shape == (11, 3)


def driven() -> saltus.Model:
    builder = saltus.read_urdf(ARM, gravity=(0, 0, 0))
    builder.add_position_servo("servo", joint="shoulder", kp=20, kd=2, effort=3)
    builder.add_motor("motor", joint="elbow", gear=10, effort=2)
    for name in ("servo", "motor"):
        builder.add_sensor(f"{name} force", "actuatorfrc", actuator=name)
    builder.add_sensor("shoulder", "jointpos", joint="shoulder")
    return with_sensors(builder, "lower", X=SITE)


def test_actuators_push_as_they_say():
    run = saltus.simulate(driven(), duration=1.0, control={"servo": 0.5, "motor": 9})
    push = 20 * (0.5 - run.q[:, 0]) - 2 * run.v[:, 0]
    np.testing.assert_allclose(run.sensor("servo force"), np.clip(push, -3, 3), atol=1e-12)
    np.testing.assert_array_equal(run.sensor("motor force"), 2)
    idle = driven().builder().set_effects("none").build()
    assert not saltus.simulate(idle, duration=0.1).sensor("motor force").any()


@pytest.mark.parametrize("control_every", [1, 3])
def test_a_policy_has_what_the_run_has(control_every):
    seen = []

    def policy(now: saltus.Moment) -> dict[str, float]:
        seen.append((now.step, dict(now.sensors)))
        return {"servo": 0.5 * np.sin(5 * now.t), "motor": 0.1}

    run = saltus.simulate(
        driven(), duration=0.3, control=policy, control_every=control_every,
        record_every=control_every,
    )  # fmt: skip
    assert len(seen) == len(run) - 1
    for name in run.model.sensor_names:
        own = run.sensor(name)
        for row, (step, sensors) in enumerate(seen):
            assert step == row * control_every
            if "force" in name:  # of the control before
                continue
            np.testing.assert_allclose(sensors[name], own[row], atol=1e-11, err_msg=name)


def test_forces_of_contacts_in_a_policy():
    seen = []
    builder = sliding().builder().add_motor("push", joint="x")
    model = builder.build()

    def policy(now: saltus.Moment) -> None:
        seen.append({name: now.sensors[name] for name in ("f", "touch")})
        assert "touch" in now.sensors
        assert len(now.sensors) == 5
        assert isinstance(now.sensors["touch"], float)
        with pytest.raises(saltus.ModelError, match='no sensor "x"; there are touch, f'):
            now.sensors["x"]

    run = saltus.simulate(
        model, {"z": 0.01}, {"x": 2.0}, duration=0.4, control=policy, record_contacts=True
    )
    assert len(run.impacts) > 0
    for name in ("f", "touch"):
        own = run.sensor(name)[:-1]
        np.testing.assert_allclose([each[name] for each in seen], own, atol=1e-9)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("s", "jointpos", {"joint": "elbw"}), 'sensor "s" is of joint "elbw", which does not exi'),
        (("s", "jointpos", {"joint": "tip"}), 'is of joint "tip", which is fixed'),
        (("s", "jointpos", {"link": "lower"}), "which is of one joint: give it by joint= alone"),
        (("s", "gyro", {}), "which is of one link: give it by link= alone"),
        (("s", "gyro", {"link": "lower", "joint": "elbow"}), "give it by link= alone"),
        (("s", "gyro", {"link": "hand"}), 'link "hand", which does not exist; links are base, upp'),
        (
            ("s", "actuatorfrc", {"actuator": "m"}),
            'actuator "m", which does not exist; actuators a',
        ),
        (("s", "speed", {"link": "lower"}), "kind = 'speed' is no SensorKind; there are jointpos"),
        (
            ("s", "touch", {"link": "lower", "other": "x"}),
            '"x", which does not exist; links and ha',
        ),
        (("s", "gyro", {"link": "lower", "other": "base"}), "only touch and contactforce sensors"),
        (("s", "jointpos", {"joint": "elbow", "X": SITE}), "a pose, which only sensors at a point"),
        (("there", "gyro", {"link": "lower"}), 'two sensors are named "there"'),
        (("", "gyro", {"link": "lower"}), "a sensor has no name"),
    ],
)
def test_sensors_that_none_are(arguments, words):
    builder = saltus.read_urdf(ARM).add_sensor("there", "gyro", link="upper")
    name, kind, others = arguments
    with pytest.raises(saltus.ModelError, match=re.escape(words)):
        builder.add_sensor(name, kind, **others)
    assert builder.build().sensor_names == ["there"]


def test_sensors_of_what_is_added_get_its_prefix():
    up = saltus.Pose((0, 0, 1))
    whole = saltus.ModelBuilder().add_floor("ground").add(sliding(), "p_", X=up).build()
    assert whole.sensor_names[:2] == ["p_touch", "p_f"]
    assert [s.other for s in whole.sensors][2:4] == ["p_puck", "p_floor"]
    run = saltus.simulate(whole, duration=0.1)
    with pytest.raises(saltus.ModelError, match='no sensor "touch"; there are p_touch, p_f'):
        run.sensor("touch")
