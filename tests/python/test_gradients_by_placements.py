"""Gradients by where joints' frames are in their parent links: differences of whole steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_step_derivatives_friction import difference
from test_step_derivatives_random import random_inertia

import saltus
from saltus import At, BodyInertia, Mimic, ModelBuilder, Pose, State, Wrench

Array = np.ndarray
Build = Callable[[Mapping[str, Array]], saltus.Model]
ZERO = np.zeros(3)
SPHERE = saltus.Sphere(0.1)


def wrong(
    build: Build,
    start: State,
    by: float = 1e-4,
    h: float = 0.01,
    keep: tuple[float, float, float] = (1, 1, 1),
    **applied: object,
) -> float:
    """Return how far the gradient of a step by all placements is from differences.

    Along a random step of each joint's placement times `keep`, relative to the largest; p is held,
    not v.
    """
    model = build({})
    stepper = saltus.Stepper(model, h=h, record=True)
    end = stepper.advance(start, **applied)
    random = np.random.default_rng(5)
    by_q, by_p = random.normal(size=(2, model.n_v))
    gradient = stepper.model_gradient(by_q, by_p).placements
    moving = [joint.name for joint in model.joints if joint.type != saltus.JointType.fixed]
    assert list(gradient) == sorted(moving)
    impacts = [impact.pairs for impact in stepper.report.impacts]
    errors, sizes = [], []
    for name, exact in gradient.items():
        step = keep * random.normal(size=3)

        def cost(x: float, name: str = name, step: Array = step) -> float:
            moved = saltus.Stepper(build({name: x * step}), h=h)
            after = moved.advance(start, **applied)
            assert [impact.pairs for impact in moved.report.impacts] == impacts
            return float(by_q @ model.difference(end.q, after.q) + by_p @ after.p)

        expected = difference(cost, by)
        errors.append(abs(exact @ step - expected))
        sizes.append(abs(expected))
    assert max(sizes) > 1e-5
    return max(errors) / max(sizes)


def driven_tree(places: Mapping[str, Array]) -> saltus.Model:
    """Return joints of all kinds, one behind a turned fixed link, and forces between points."""
    random = np.random.default_rng(3)
    builder = ModelBuilder("tree").set_gravity((1.0, -2.0, -9.0))
    turned = Rotation.from_rotvec((0.4, -0.3, 0.8)).as_matrix()
    for name, kind, parent in (
        ("base", "floating", "world"),
        ("shoulder", "spherical", "base"),
        ("wrist", "fixed", "shoulder"),
        ("slide", "prismatic", "wrist"),
        ("screw", "helical", "slide"),
        ("elbow", "revolute", "wrist"),
        ("follower", "revolute", "elbow"),
        ("pole", "revolute", "world"),
    ):
        builder.add_link(name, random_inertia(random))
        at, axis = random.normal(size=(2, 3))
        X = Pose(0.3 * at + places.get(f"j_{name}", ZERO), turned)
        pitch = {"pitch": 0.1} if kind == "helical" else {}
        if name == "follower":
            pitch["mimic"] = Mimic("j_elbow", -0.7, 0.2)
        joint = f"j_{name}"
        builder.add_joint(joint, kind, parent=parent, child=name, X_PJ=X, axis=axis, **pitch)
    builder.add_position_servo("servo", joint="j_slide", kp=20, kd=2).set_damping("j_screw", 0.4)
    builder.add_spring("tie", a=At("screw", (0.1, 0.2, 0)), b="world", stiffness=30.0, length=0.2)
    builder.add_spring("soft", a="follower", b=At("base", (0, 0, 0.1)), stiffness=9.0, damping=2.0)
    builder.add_spring("damper", a=At("pole", (0.3, 0, 0)), b="elbow", damping=1.5)
    return builder.set_gravity_compensation("elbow", 0.6).build()


@pytest.mark.parametrize("seed", range(6))
def test_a_step_of_joints_of_all_kinds(seed):
    model = driven_tree({})
    random = np.random.default_rng(seed)
    start = model.state(model.random_configuration(seed), 2 * random.normal(size=model.n_v))
    forces = {
        "follower": Wrench((3.0, -2.0, 4.0), point=(0.1, 0.2, 0.3)),
        "base": Wrench((1, 2, 3)),
    }
    # arcs are solved to 1e-12, and differences of eighth order have a step of 1e-3
    assert wrong(driven_tree, start, 1e-3, forces=forces) < 1e-9


def gripper(restitution: float, friction: float = 0.0) -> Build:
    """Return two arms of two links each, whose tips meet between them; one slides on the way."""

    def build(places: Mapping[str, Array]) -> saltus.Model:
        builder = ModelBuilder()
        for side, x in (("left", -0.5), ("right", 0.5)):
            parent, at = "world", np.array([x, 0, 0])
            for name, kind, axis in (
                ("upper", "spherical", (0, 1, 0)),
                ("lower", "revolute", (0.1, 1, 0.2 * x)),
                ("tip", "prismatic", (0.2, 0.1, 1)),
            ):
                link, joint = f"{side}_{name}", f"{side}_{name}_joint"
                inertia = BodyInertia(1, (0.02, 0.01, -0.2), np.diag([0.02, 0.03, 0.02]))
                builder.add_link(link, inertia)
                X = Pose(at + places.get(joint, ZERO))
                builder.add_joint(joint, kind, parent=parent, child=link, X_PJ=X, axis=axis)
                parent, at = link, np.array([0.03, 0.02, -0.4])
            shape = saltus.Sphere(0.1) if side == "left" else saltus.Box((0.1, 0.08, 0.06))
            builder.add_shape(parent, shape, Pose((0, 0, -0.05)))
        return builder.set_default_contact(restitution=restitution, friction=friction).build()

    return build


def meeting(build: Build, h: float = 0.01) -> State:
    """Return the start of the first step with an impact of arms that swing to each other."""
    model = build({})
    turned = [Rotation.from_rotvec((0.1, x, 0.05)).as_quat() for x in (-0.25, 0.3)]
    q = np.concatenate([turned[0], [-0.2, 0.05], turned[1], [0.25, -0.02]])
    v = np.array([0.3, -1.2, 0.2, -1.0, 0.1, -0.2, 1.4, 0.3, 0.8, -0.3])
    state = model.state(q, v)
    stepper = saltus.Stepper(model, h=h)
    for _ in range(100):
        after = stepper.advance(state)
        if stepper.report.impacts:
            return State(0.0, state.q, state.p)
        state = after
    raise AssertionError


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("friction", [0.0, 0.05, 0.8], ids=["smooth", "slides", "sticks"])
def test_an_impact_of_two_arms(restitution, friction):
    build = gripper(restitution, friction)
    assert wrong(build, meeting(build)) < 1e-7  # differences by 1e-4 of steps solved to 1e-12


def test_impulses_one_after_the_other():
    """A cradle of two balls that touch, hit by a third, on a cart: two impulses at an instant."""

    def build(places: Mapping[str, Array]) -> saltus.Model:
        builder = ModelBuilder()
        builder.add_link("cart", BodyInertia(3, (0, 0, 0.1), 0.1 * np.eye(3)))
        X = Pose(places.get("roll", ZERO))
        builder.add_joint("roll", "prismatic", parent="world", child="cart", X_PJ=X)
        for i, x in enumerate((0, 0.102, 0.25)):
            name = f"ball_{i}"
            builder.add_link(name, BodyInertia(1, (0, 0, -1), 0.001 * np.eye(3)))
            builder.add_shape(name, saltus.Sphere(0.05), Pose((0, 0, -1)))
            at = Pose(np.array([x, 0, 0]) + places.get(f"swing_{i}", ZERO))
            axis = (0, -1, 0)
            builder.add_joint(
                f"swing_{i}", "revolute", parent="cart", child=name, X_PJ=at, axis=axis
            )
        return builder.set_default_contact(restitution=0.9).build()

    start = build({}).state([0.0, 0.0, 0.0, 0.0], [0.2, 3.0, 0.1, 0.0])
    assert wrong(build, start, 1e-5, h=0.08) < 1e-6  # of a smaller step


def tray(friction: float, shape: saltus.Sphere | saltus.Box = SPHERE) -> Build:
    """Return a tray that a spring holds level, and a body that moves freely on it."""

    def build(places: Mapping[str, Array]) -> saltus.Model:
        builder = ModelBuilder()
        builder.add_link("tray", BodyInertia(5, (0, 0, -0.1), 0.3 * np.eye(3)))
        builder.add_shape("tray", saltus.Box((1.0, 1.0, 0.1)), Pose((0, 0, -0.1)))
        X = Pose(places.get("tilt", ZERO))
        builder.add_joint(
            "tilt", "revolute", parent="world", child="tray", X_PJ=X, axis=(0.1, 1, 0), damping=1.0
        )
        builder.add_joint_spring("tilt", stiffness=200.0)
        builder.add_link("slide", BodyInertia(1, (0, 0, 0), 0.01 * np.eye(3)))
        X = Pose(np.array([0.1, 0.2, 0.0]) + places.get("free", ZERO))
        builder.add_joint("free", "floating", parent="world", child="slide", X_PJ=X)
        builder.add_shape("slide", shape)
        return builder.set_default_contact(restitution=0.0, friction=friction).build()

    return build


@pytest.mark.parametrize(("friction", "speed"), [(0.0, 1.0), (0.1, 1.0), (0.6, 0.0)])
def test_a_ball_that_is_held(friction, speed):
    """On a tray that is level at the start: steps along it keep it there."""
    build = tray(friction)
    model = build({})
    q = model.state({"free": Pose((0, 0, 0.1))}).q
    spin = (0.2, speed * 10 - 3.0, 0.4) if friction < 0.5 else (-2.0, 5.0, 0.0)
    v = (0.0, speed + 0.5 * (friction > 0.5), 0.2, 0, *spin)
    start = model.state(q, v)
    stepper = saltus.Stepper(model)
    stepper.advance(start)
    assert stepper.report.sustained == 1
    assert not stepper.report.impacts
    assert wrong(build, start, keep=(1, 1, 0)) < 1e-7


@pytest.mark.parametrize(("friction", "speed"), [(0.0, 0.5), (0.1, 0.5), (0.9, 0.0)])
def test_a_corner_that_is_held(friction, speed):
    """A box that stands on one corner on the tray, and slides or tips over it."""
    build = tray(friction, saltus.Box((0.1, 0.15, 0.2)))
    model = build({})
    R = Rotation.from_rotvec((0.5, -0.4, 0.2)).as_matrix()
    low = -(np.abs(R) @ [0.1, 0.15, 0.2])[2]
    corner = R @ (-np.sign(R[2]) * [0.1, 0.15, 0.2])
    assert corner[2] == pytest.approx(low)
    spin = np.array([0.3, -0.2, 0.1])
    velocity = np.array([speed, 0.3 * speed, 0]) - np.cross(spin, corner)
    q = model.state({"free": Pose((0, 0, -low), R)}).q
    start = model.state(q, np.concatenate([[0.0], velocity, spin]))
    stepper = saltus.Stepper(model)
    stepper.advance(start)
    assert stepper.report.sustained == 1
    assert wrong(build, start, keep=(1, 1, 0)) < 1e-7


def test_the_weight_at_the_end_of_a_rod():
    """A level rod with a weight that turns on its end: its momentum changes by -m g length h."""
    g, h, m, length = 9.81, 0.01, 2.0, 0.7

    builder = ModelBuilder().add_link("rod", BodyInertia(0, ZERO, np.zeros((3, 3))))
    builder.add_joint("swing", "revolute", parent="world", child="rod", axis=(0, -1, 0))
    builder.add_link("bob", BodyInertia(m, ZERO, 1e-3 * np.eye(3)))
    X = Pose((0, 0, -length))
    builder.add_joint("spin", "revolute", parent="rod", child="bob", X_PJ=X)
    stepper = saltus.Stepper(builder.build(), h=h, record=True)
    stepper.advance(State(0.0, [np.pi / 2, 0.0], [0.0, 0.0]))
    by_place = stepper.model_gradient(np.zeros(2), [1.0, 0.0]).placements["spin"]
    # z of the rod points against its end; what falls turns it by (h/2)^2 g / length = 4e-4
    np.testing.assert_allclose(by_place, [0, 0, m * g * h], atol=1e-3 * m * g * h)


def test_a_run_by_the_length_of_an_arm():
    """A double pendulum that hits a wall in its run."""

    def build(x: float) -> saltus.Model:
        builder = ModelBuilder().add_half_space("wall", (-1, 0, 0), -0.6)
        for name, parent, at in (("upper", "world", 0.0), ("lower", "upper", -1.0 + x)):
            builder.add_link(name, BodyInertia(1.0, (0, 0, -0.8), 0.001 * np.eye(3)))
            X = Pose((0, 0, at))
            builder.add_joint(name, "revolute", parent=parent, child=name, X_PJ=X, axis=(0, -1, 0))
        builder.add_shape("lower", saltus.Sphere(0.05), Pose((0, 0, -0.8)))
        return builder.set_default_contact(restitution=0.8).build()

    def run(x: float) -> saltus.Trajectory:
        start = State(0.0, [0.1, 0.05], [6.0, 2.0])
        return saltus.simulate(build(x), state=start, duration=0.5, h=0.02, progress=False)

    made = run(0.0)
    assert len(made.impacts) > 0
    c = np.array([1.0, -0.5])
    expected = difference(lambda x: float(c @ run(x).q[-1]), 1e-5)
    exact = made.gradient(c, np.zeros(2)).placements["lower"][2]
    assert exact == pytest.approx(expected, rel=1e-6)


def test_a_stop_does_not_know_where_its_joint_is():
    builder = ModelBuilder().add_link("rod", BodyInertia(1, (0.2, 0, 0), 0.01 * np.eye(3)))
    builder.add_joint(
        "swing", "revolute", parent="world", child="rod", axis=(0, 1, 0), lower=-1.0, upper=0.1
    )
    model = builder.build()
    stepper = saltus.Stepper(model, h=0.05, record=True)
    stepper.advance(model.state([0.05], [3.0]))
    assert len(stepper.report.impacts) == 1
    np.testing.assert_array_equal(stepper.model_gradient([1.0], [1.0]).placements["swing"], 0)
