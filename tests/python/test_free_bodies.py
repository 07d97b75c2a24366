"""Free and ball joints from Python: what a user writes for them, batches, files, motion."""

from __future__ import annotations

import math
import pickle

import h5py
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import saltus

HALF = (0.1, 0.2, 0.3)


def brick(joint: saltus.JointType = saltus.JointType.floating) -> saltus.Model:
    return (
        saltus.ModelBuilder("brick")
        .add_link("brick", saltus.solid_box(1.0, half=HALF))
        .add_joint("free", joint, parent="world", child="brick")
        .build()
    )


def test_names_of_numbers():
    model = brick()
    assert (model.n_q, model.n_v) == (7, 6)
    assert model.coordinate_names == [f"free_{s}" for s in ("x", "y", "z", "qx", "qy", "qz", "qw")]
    assert model.velocity_names == [f"free_{s}" for s in ("vx", "vy", "vz", "wx", "wy", "wz")]
    assert model.velocity_index("free_wz") == 5
    ball = brick(saltus.JointType.spherical)
    assert ball.coordinate_names == [f"free_q{s}" for s in "xyzw"]
    assert ball.velocity_names == [f"free_w{s}" for s in "xyz"]
    assert [c.unit for c in model.coordinates] == ["m"] * 3 + ["1"] * 4
    assert repr(model) == "Model('brick', 7 coordinates, 6 velocities, 0 shapes, 0 pairs)"


def test_a_joint_takes_all_that_is_a_pose():
    model, turn = brick(), Rotation.from_euler("xyz", (0.3, -0.2, 1.1))
    pose = saltus.Pose((1, 2, 3), turn.as_matrix())
    wanted = np.concatenate([(1, 2, 3), turn.as_quat()])
    for value in (pose, ((1, 2, 3), turn.as_quat()), ((1, 2, 3), turn), wanted, list(wanted)):
        np.testing.assert_allclose(model.state(q={"free": value}).q, wanted, atol=1e-15)
    at_origin = model.state(q={"free": turn}).q
    np.testing.assert_allclose(at_origin, np.concatenate([(0, 0, 0), turn.as_quat()]), atol=1e-15)
    ball = brick(saltus.JointType.spherical)
    for value in (turn, turn.as_quat()):
        np.testing.assert_allclose(ball.state(q={"free": value}).q, turn.as_quat(), atol=1e-15)
    spin = model.state(v={"free": ((1, 2, 3), (4, 5, 6))})
    assert list(spin.p[:3]) == [1, 2, 3]
    np.testing.assert_allclose(model.velocity(spin), [1, 2, 3, 4, 5, 6], rtol=1e-14)


@pytest.mark.parametrize(
    ("q", "message"),
    [
        ({"free": (1, 2, 3)}, 'has 3 numbers; joint "free" takes a Pose, a Rotation, or position'),
        (
            {"free": ((0, 0, 0), (0, 0, 0, 2))},
            r'quaternion \(0 0 0 2\) for joint "free", of length 2',
        ),
        ({"free": "up"}, "'up' is no number"),
        ({"fre": 1}, 'no coordinate "fre"; there are free_x, .*free_qw, free'),
        ({"free": saltus.Pose(), "free_z": 1}, '"free_z" twice, by its name and by its joint'),
        ({"free_qw": 0.5}, "of length 0.5; its length is 1"),
        ({"free_qw": 1.000002}, "of length 1.000002; its length is 1"),
        ({"free_x": math.nan}, "is not finite"),
        ({"free_x": "1"}, "'1' is no number"),
        ({"free_x": True}, "True is no number"),
        (["0", "0", "0", "0", "0", "0", "1"], "q holds texts; it is an array of numbers"),
        ([False] * 6 + [True], "q holds truth values"),
        (
            {"free": saltus.Pose((0, 0, 0), np.diag([1, 1, -1]))},
            "R is no rotation: its determinant",
        ),
        ({"free": saltus.Pose((0, 0, 0), 2 * np.eye(3))}, "R is no rotation"),
        ({"free": ((0, 0), (0, 0, 0, 0, 1))}, "has 7 numbers in parts of 2, 5; .* takes a Pose"),
        ([0, 0, 1, 0, 0, 0], "q has 6 entries; the model has 7 coordinates"),
    ],
)
def test_mistakes_are_named(q, message):
    with pytest.raises(saltus.ModelError, match=message):
        brick().state(q=q)


def test_mistakes_in_velocities_are_named():
    with pytest.raises(saltus.ModelError, match="takes velocity and angular velocity"):
        brick().state(v={"free": (1, 2)})
    with pytest.raises(
        saltus.ModelError, match=r"6 numbers in parts of 2, 2, 2; .* takes velocity"
    ):
        brick().state(v={"free": np.array(((1, 0, 0), (0, 0, 5))).T})
    with pytest.raises(saltus.ModelError, match='no velocity "free_x"; there are free_vx'):
        brick().state(v={"free_x": 1})
    with pytest.raises(saltus.ModelError, match="is a Pose; a ball joint takes a quaternion"):
        brick(saltus.JointType.spherical).state(q={"free": saltus.Pose()})


def test_poses_and_quaternions():
    for pitch in (0.4, math.pi / 2, -math.pi / 2, 1.5):
        pose = saltus.Pose.from_rpy(0.2, pitch, -2.0, p=(1, 2, 3))
        again = saltus.Pose.from_rpy(*pose.rpy)
        np.testing.assert_allclose(again.R, pose.R, atol=1e-15)
        same = saltus.Pose.from_quaternion(-2 * pose.quaternion, p=pose.p)
        np.testing.assert_allclose(same.matrix(), pose.matrix(), atol=1e-15)
        np.testing.assert_allclose(
            Rotation.from_quat(pose.quaternion).as_matrix(), pose.R, atol=1e-15
        )
    with pytest.raises(saltus.ModelError, match=r"quaternion \(0 0 0 0\)"):
        saltus.Pose.from_quaternion((0, 0, 0, 0))


def test_integrate_and_difference():
    model = brick()
    rng = np.random.default_rng(3)
    for _ in range(20):
        q, dv = model.random_configuration(rng), rng.uniform(-1.5, 1.5, 6)
        moved = model.integrate(q, dv)
        turn = Rotation.from_rotvec(dv[3:]) * Rotation.from_quat(q[3:])
        assert (Rotation.from_quat(moved[3:]) * turn.inv()).magnitude() < 1e-14
        np.testing.assert_allclose(model.difference(q, moved), dv, atol=1e-14)
        opposite = np.concatenate([moved[:3], -moved[3:]])
        np.testing.assert_allclose(model.difference(moved, opposite), np.zeros(6), atol=1e-15)
    assert (model.random_configuration(5) == model.random_configuration(5)).all()
    assert np.abs(np.linalg.norm(model.normalized([0, 0, 0, 3, 4, 0, 0])[3:]) - 1) < 1e-15


def test_random_orientations_are_uniform():
    """Of uniform rotations every entry of R has mean 0 and mean square 1/3."""
    model = brick(saltus.JointType.spherical)
    rng = np.random.default_rng(1)
    R = np.array([saltus.Pose.from_quaternion(model.random_configuration(rng)).R
                  for _ in range(4000)])  # fmt: skip
    # 4000 draws: a standard deviation of 0.01 and of 0.005
    assert np.abs(R.mean(axis=0)).max() < 0.05
    assert np.abs((R**2).mean(axis=0) - 1 / 3).max() < 0.025


def test_velocities_are_in_the_worlds_axes():
    """A body that lies on its side and is pushed along x and spun about z goes along x about z."""
    model, on_its_side = brick(), saltus.Pose.from_rpy(math.pi / 2, 0, 0)
    run = saltus.simulate(model, q={"free": on_its_side}, v={"free_vx": 2, "free_wz": 3},
                          duration=0.5, h=0.01)  # fmt: skip
    twist = run.velocities("brick")[0]
    np.testing.assert_allclose(twist, [0, 0, 3, 2, 0, 0], atol=1e-14)
    assert run.column("free_x")[-1] == pytest.approx(1.0, abs=1e-13)
    turned = Rotation.from_quat(run.q[-1, 3:]) * Rotation.from_matrix(on_its_side.R).inv()
    np.testing.assert_allclose(turned.as_rotvec(), [0, 0, 1.5], atol=1e-12)
    assert run.column("free_wz", "v")[-1] == pytest.approx(3, abs=1e-12)
    with pytest.raises(saltus.ModelError, match=r'no coordinate "free_wz" \("free_wz" is a column'):
        run.column("free_wz")


def test_a_batch_of_orientations():
    model, turns = brick(), Rotation.from_rotvec(np.outer([0.1, 1.5, 3.0], (0, 1, 0)))
    poses = np.column_stack([np.zeros((3, 2)), [1, 2, 3], turns.as_quat()])
    batch = saltus.simulate_batch(
        model, q={"free": poses}, v={"free_wy": [1, 2, 3], "free_vx": 0.5}, duration=0.1
    )
    assert batch.q.shape == (3, 11, 7)
    assert batch.v.shape == (3, 11, 6)
    for i in range(3):
        alone = saltus.simulate(model, q={"free": poses[i]}, v={"free_wy": i + 1, "free_vx": 0.5},
                                duration=0.1)  # fmt: skip
        assert (batch[i].q == alone.q).all()
        assert (batch[i].p == alone.p).all()
    one_for_all = saltus.simulate_batch(model, q={"free_z": [1, 2]}, duration=0.1)
    assert (one_for_all.q[:, 0, 6] == 1).all()
    balls = saltus.simulate_batch(
        brick(saltus.JointType.spherical), q={"free": turns}, duration=0.1
    )
    np.testing.assert_allclose(balls.q[:, 0], turns.as_quat(), atol=1e-15)
    with pytest.raises(saltus.ModelError, match=r'q\["free"\] has shape \(3, 4\)'):
        saltus.simulate_batch(model, q={"free": turns.as_quat()}, duration=0.1)


def test_files_hold_both_kinds_of_names(tmp_path):
    model = brick()
    run = saltus.simulate(model, v={"free_wy": 3}, duration=0.1)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5", model=model)
    assert again.velocity_names == tuple(model.velocity_names)
    assert (again.q == run.q).all()
    with h5py.File(tmp_path / "run.h5", "a") as file:  # as it was before
        file.attrs["version"] = 1
        del file["velocity_names"], file["coordinate_names"]
        names = ["x", "y", "z", "yaw", "pitch", "roll"]
        file["coordinate_names"] = [f"free_{name}" for name in names]
    with pytest.raises(saltus.ModelError, match='joint "free" as yaw, pitch and roll'):
        saltus.load(tmp_path / "run.h5")


def test_files_of_before_without_free_joints_are_read(tmp_path):
    model = saltus.load_urdf(saltus.scenes.chain(2))
    run = saltus.simulate(model, q=[0.1, 0.2], duration=0.1)
    run.save(tmp_path / "run.h5")
    with h5py.File(tmp_path / "run.h5", "a") as file:
        file.attrs["version"] = 1
        del file["velocity_names"]
    assert saltus.load(tmp_path / "run.h5").velocity_names == run.coordinate_names


def test_models_and_states_go_to_other_processes():
    model = pickle.loads(pickle.dumps(brick()))
    state = pickle.loads(pickle.dumps(model.state(q={"free_z": 2})))
    assert state.q[2] == 2
    assert model.velocity_names == brick().velocity_names


def test_law_compensated_is_refused_in_words():
    with pytest.raises(saltus.ModelError, match='not for floating and spherical joints, as "free"'):
        saltus.simulate(brick(), duration=0.1, law=saltus.ImpactLaw.compensated)


def dominoes() -> saltus.Model:
    builder = saltus.ModelBuilder("dominoes").add_half_space("floor", (0, 0, 1))
    builder.set_default_contact(restitution=0.0, friction=0.5)
    half = (0.02, 0.1, 0.2)
    for i in range(3):
        builder.add_body(f"d{i}", saltus.Box(half), mass=1.0)
    return builder.build()


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 30, 90, 135, 180, 270])
def test_three_dominoes_fall_in_every_direction(degrees):
    """Every domino stands turned by the direction, so that no axis of the world is special."""
    along = saltus.Pose.from_rpy(0, 0, math.radians(degrees))
    q = {f"d{i}": along * saltus.Pose((0.2 * i, 0, 0.2)) for i in range(3)}
    # The first turns about its lower front edge. It is over it with 1/2 (4/3) m r^2 w^2 >
    # m g (r - 0.2), r = |(0.02, 0.2)|: from w = 0.6 rad/s on.
    w = np.array((0, 1.5, 0))
    twist = np.concatenate([along.R @ np.cross(w, (-0.02, 0, 0.2)), along.R @ w])
    run = saltus.simulate(dominoes(), q=q, v={"d0": twist}, duration=2.0, h=0.005)
    last = run.q[-1].reshape(3, 7)
    assert np.abs(run.v[-1]).max() < 1e-12  # they rest on each other
    R = [along.R.T @ saltus.Pose.from_quaternion(x[3:]).R for x in last]
    # The last lies on the floor; the others lean, by 0.2 within 0.02, on the next one: edges that
    # meet with friction in one direction meet at one end first in another, by rounding.
    np.testing.assert_allclose([r[2, 2] for r in R], [0.2, 0.2, 0], atol=0.02)
    np.testing.assert_allclose([r[2, 0] for r in R], [-0.98, -0.98, -1], atol=0.02)
    x = last[:, :3] @ along.R
    np.testing.assert_allclose(x[:, 0], [0.235, 0.428, 0.631], atol=0.02)
    np.testing.assert_allclose(x[:, 1], 0, atol=0.02)
    # A step's error of energy is O(h^2), and 2e-5 J at h = 5 ms where it is greatest
    assert run.total.max() < run.total[0] + 5e-5
