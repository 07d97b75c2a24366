"""Model and State as a user sees them."""

from __future__ import annotations

import copy
import math
import pickle

import numpy as np
import pytest
from helpers import central_differences, random_state
from hypothesis import given
from hypothesis import strategies as st
from scenes import chain, cradle

import saltus


def test_names_and_lists():
    model = cradle()
    assert model.coordinate_names == [f"{j}_{i}" for i in range(3) for j in ("swing", "sway")]
    assert model.joint_names == model.coordinate_names
    assert "ball_1" in model.link_names
    assert model.pair_names == ["ball_0 ~ ball_1", "ball_0 ~ ball_2", "ball_1 ~ ball_2"]
    assert [s.name for s in model.shapes] == ["ball_0", "ball_1", "ball_2"]
    assert isinstance(model.shapes[0].shape, saltus.Sphere)
    assert model.link_names[model.shapes[1].link] == "ball_1"
    assert [(pair.a, pair.b) for pair in model.pairs] == [(0, 1), (0, 2), (1, 2)]
    assert model.joints[0].type is saltus.JointType.continuous
    assert (model.joints[0].parent, model.joints[0].child) == ("frame", "gimbal_0")
    assert model.coordinates[0].unit == "rad"
    assert model.coordinates[0].upper == math.inf
    np.testing.assert_array_equal(model.gravity, [0, 0, -9.81])
    assert "<robot" in model.source
    assert "6 coordinates" in repr(model)


def test_parts_outlive_the_model():
    shapes = saltus.load_urdf(saltus.scenes.cradle(2)).shapes
    assert [shape.name for shape in shapes] == ["ball_0", "ball_1"]


def test_mapping_and_array_mean_the_same():
    model = cradle()
    by_name = model.state(q={"swing_0": 0.3, "sway_2": -0.1}, v={"swing_1": 1})
    q, v = np.zeros(6), np.zeros(6)
    q[model.coordinate("swing_0")], q[model.coordinate("sway_2")] = 0.3, -0.1
    v[model.coordinate("swing_1")] = 1
    assert by_name == model.state(q, v) == model.state(list(q), tuple(v))
    assert by_name != model.state(q, v, t=1.0)
    np.testing.assert_array_equal(by_name.q, q)
    np.testing.assert_allclose(model.velocity(by_name), v, atol=1e-15)
    for function in (model.mass_matrix, model.potential_energy):
        np.testing.assert_array_equal(function(q), function({"swing_0": 0.3, "sway_2": -0.1}))
    np.testing.assert_array_equal(
        model.gaps(q).phi,
        model.gaps(dict(zip(model.coordinate_names, q, strict=True))).phi,
    )


def test_nothing_given_is_zero():
    state = cradle().state()
    assert state.t == 0
    assert not state.q.any()
    assert not state.p.any()


@pytest.mark.parametrize(
    ("q", "message"),
    [
        ({"elbow": 1}, 'no coordinate "elbow"; there are swing_0, sway_0'),
        ({3: 1}, "q has the key 3; keys are names of coordinates: swing_0"),
        ({"swing_0": "much"}, "q[\"swing_0\"] = 'much' is no number"),
        ({"swing_0": math.nan}, 'q["swing_0"] = nan is not finite'),
        ({"sway_2": np.float64("-inf")}, 'q["sway_2"] = -inf is not finite'),
        ([0, 0, math.inf, 0, 0, 0], "q[2] = inf is not finite"),
        (np.zeros(5), "q has 5 entries; the model has 6 coordinates"),
        (np.zeros((6, 1)), "q has shape (6, 1); it must have shape (6,)"),
        (0.3, "q has shape (); it must have shape (6,)"),
        ("swing_0", 'no state "swing_0"; there are none'),
        ([1, [2, 3]], "q is no array of numbers"),
        (object(), "q is no array of numbers"),
    ],
)
def test_wrong_coordinates_are_explained(q, message):
    model = cradle()
    for function in (model.state, model.gaps, model.mass_matrix, model.potential_energy):
        with pytest.raises(saltus.ModelError) as error:
            function(q)
        assert message in str(error.value)
    with pytest.raises(saltus.ModelError):
        model.lagrangian(q, np.zeros(6))


def test_errors_carry_the_culprit():
    with pytest.raises(saltus.ModelError) as error:
        cradle().state({"elbow": 1})
    assert isinstance(error.value, ValueError)
    assert (error.value.element, error.value.name) == ("coordinate", "elbow")
    assert saltus.ModelError("made in Python").name == ""
    assert math.isnan(saltus.StepError("made in Python").t)
    assert issubclass(saltus.JammedError, saltus.StepError)
    assert issubclass(saltus.StepError, RuntimeError)
    with pytest.raises(saltus.ModelError, match="v has 5 entries"):
        cradle().state(np.zeros(6), np.zeros(5))
    with pytest.raises(saltus.ModelError, match="t is not finite"):
        cradle().state(t=math.nan)


def test_gaps_and_their_gradients():
    model = cradle()
    q, _ = random_state(model, seed=3)
    gaps = model.gaps(q)
    assert len(gaps) == 3
    assert gaps.names == model.pair_names
    numeric = central_differences(lambda x: model.gaps(x).phi, q)
    np.testing.assert_allclose(gaps.phi_q, numeric, rtol=1e-6, atol=1e-8)
    numeric = central_differences(lambda x: model.gaps(x).phi_q, q)
    np.testing.assert_allclose(np.stack(gaps.phi_qq), numeric, rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(gaps.p_WA - gaps.p_WB, gaps.phi[:, None] * gaps.normal, atol=1e-14)


def test_without_collisions():
    model = cradle().without_collisions()
    assert model.pairs == []
    assert len(cradle().pairs) == 3
    assert len(model.gaps(np.zeros(6))) == 0


def test_poses_by_name_and_index():
    model = cradle()
    pose = model.pose({"swing_0": math.pi / 2}, "ball_0")
    bottom = pose * np.array([0, 0, -1.0])
    np.testing.assert_allclose(bottom, [-1.1, 0, 1], atol=1e-15)  # positive swing: towards -x
    same = model.pose({"swing_0": math.pi / 2}, model.link("ball_0"))
    np.testing.assert_array_equal(same.matrix(), pose.matrix())
    assert pose.matrix().shape == (4, 4)
    with pytest.raises(saltus.ModelError, match="no link 'ball_9'; there are frame"):
        model.pose({}, "ball_9")
    with pytest.raises(saltus.ModelError, match="no link 99"):
        model.pose({}, 99)
    with pytest.raises(saltus.ModelError, match=r"no link 0\.5"):
        model.pose({}, 0.5)


def test_the_pose_of_a_link_by_hand():
    """Two links of 0.2 m below each other: the first turns about x, the second about y."""
    a, b = 0.3, -0.7
    c, s = math.cos(a), math.sin(a)
    about_x = [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]]
    c, s = math.cos(b), math.sin(b)
    about_y = [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, -0.2], [0, 0, 0, 1]]
    expected = np.array(about_x) @ about_y
    model = chain(2)
    np.testing.assert_allclose(model.pose([a, b], "link_1").matrix(), expected, atol=1e-15)
    tip = model.pose({"joint_0": a, "joint_1": b}, "link_1") * (0, 0, -0.2)
    drop = 0.2 * (1 + math.cos(b))
    by_hand = [-0.2 * math.sin(b), drop * math.sin(a), -drop * math.cos(a)]
    np.testing.assert_allclose(tip, by_hand, atol=1e-15)
    for wrong in ([0.1], [0.1, math.inf], {"joint_9": 0.1}):
        with pytest.raises(saltus.ModelError):
            model.pose(wrong, "link_1")


def test_many_poses_and_velocities():
    model = chain(3)
    rng = np.random.default_rng(0)
    q, v = rng.uniform(-1, 1, (2, 5, 3))
    poses = model.poses(q, "link_2")
    assert poses.shape == (5, 4, 4)
    for row in range(5):
        np.testing.assert_array_equal(poses[row], model.pose(q[row], "link_2").matrix())
    velocities = model.velocities(q, v, "link_2")
    step = 1e-6
    after, before = model.poses(q + step * v, "link_2"), model.poses(q - step * v, "link_2")
    rates = (after - before) / (2 * step)
    np.testing.assert_allclose(velocities[:, 3:], rates[:, :3, 3], atol=1e-9)
    spin = rates[:, :3, :3] @ poses[:, :3, :3].transpose(0, 2, 1)
    expected = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
    np.testing.assert_allclose(velocities[:, :3], expected, atol=1e-9)
    assert not model.velocities(q, v, "frame").any()
    for wrong in (np.zeros((5, 2)), np.full((5, 3), np.nan)):
        with pytest.raises(saltus.ModelError, match=r"rows? .*of q"):
            model.poses(wrong, "link_2")
    with pytest.raises(saltus.ModelError, match="q has 5 rows and v 4"):
        model.velocities(q, v[:4], "link_2")


def test_shape_frames():
    model = cradle()
    centre = model.shape_poses(np.zeros((1, 6)), "ball_1")[0, :3, 3]
    np.testing.assert_allclose(centre, [0, 0, 0], atol=1e-15)
    v = np.zeros((1, 6))
    v[0, 2] = 2.0  # swing_1
    velocity = model.shape_velocities(np.zeros((1, 6)), v, 1)
    np.testing.assert_allclose(velocity, [[0, 2, 0, -2, 0, 0]], atol=1e-15)


numbers = st.floats(allow_nan=False, allow_infinity=False)


@given(
    t=numbers,
    rows=st.lists(st.tuples(numbers, numbers), max_size=5),
)
def test_state_is_a_value(t, rows):
    q, p = [row[0] for row in rows], [row[1] for row in rows]
    state = saltus.State(t, q, p)
    for other in (copy.copy(state), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
        assert other is not state
        assert other == state
        assert not np.shares_memory(other.q, state.q) or not rows


def test_state_cannot_be_changed_by_accident():
    state = cradle().state({"swing_0": 0.3})
    with pytest.raises(AttributeError):
        state.t = 1.0
    with pytest.raises(ValueError, match="read-only"):
        state.q[0] = 1.0
    assert state != "a state"
    assert repr(state).startswith("State(t=0.0, q=[0.3,")
    with pytest.raises(TypeError, match="unhashable"):
        hash(state)


def test_velocity_of_a_foreign_state():
    with pytest.raises(saltus.ModelError, match=r"state.q has 3 entries"):
        cradle().velocity(chain(3).state())


def test_energies():
    model = chain(2)
    state = model.state([0.3, 0.1], [1.0, -2.0])
    energies = saltus.energies(model, state, 0.01)
    assert energies.kinetic == pytest.approx(model.kinetic_energy(state), rel=1e-13)
    assert energies.potential == pytest.approx(model.potential_energy(state.q), rel=1e-13)
    assert energies.shadow != energies.kinetic + energies.potential
    assert energies.shadow == pytest.approx(energies.kinetic + energies.potential, rel=1e-2)


def test_inertia_of_solids():
    box, pole = saltus.solid_box(3.0, (1.0, 2.0, 3.0)), saltus.solid_cylinder(12.0, 2.0, 0.5)
    np.testing.assert_allclose(np.diag(box.I_J), (13.0, 10.0, 5.0), rtol=1e-15)  # (y^2 + z^2) m/3
    # along r^2 m/2, across r^2 m/4 + l^2 m/3
    np.testing.assert_allclose(np.diag(pole.I_J), (13.0, 13.0, 24.0), rtol=1e-15)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_solids_of_no_size_or_mass_are_refused(bad):
    for make in (
        lambda: saltus.solid_sphere(1.0, bad),
        lambda: saltus.solid_sphere(bad, 1.0),
        lambda: saltus.solid_box(1.0, (1.0, bad, 1.0)),
        lambda: saltus.solid_cylinder(1.0, 1.0, bad),
    ):
        with pytest.raises(saltus.ModelError, match=f"a solid .*{bad:g}.*finite and positive"):
            make()
