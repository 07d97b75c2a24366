"""Loops that say the same twice, contradict each other, or meet what is told: never a NaN."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.test_loops import chain, four_bar

import saltus
from saltus import At, BodyInertia, Mimic, ModelBuilder, ModelError, Pose

Z = (0.0, 0.0, 1.0)


def rod(length: float) -> BodyInertia:
    return saltus.solid_box(1.0, (length, 0.02, 0.02)).seen_from(Pose((length / 2, 0, 0)))


def hinge_of_two_points() -> tuple[saltus.Model, dict]:
    builder = ModelBuilder()
    for name, x in (("a", 0.0), ("b", 0.3)):
        builder.add_body(name, saltus.Box((0.1, 0.1, 0.1)), mass=1.0, X=Pose((x, 0, 0)))
    for y in (-0.1, 0.1):
        builder.add_loop(f"pin {y}", "point", a=At("a", (0.15, y, 0)), b=At("b", (-0.15, y, 0)))
    return builder.build(), {}


def four_bar_that_floats() -> tuple[saltus.Model, dict]:
    builder = ModelBuilder().add_link("base", saltus.solid_box(2.0, (0.1, 0.1, 0.1)))
    builder.add_joint("base", "floating", parent="world", child="base")
    parent, at = "base", 0.0
    for name, length in (("crank", 0.4), ("coupler", 1.0), ("rocker", 0.8)):
        builder.add_link(name, rod(length))
        builder.add_joint(
            name, "revolute", parent=parent, child=name, axis=Z, X_PJ=Pose((at, 0, 0))
        )
        parent, at = name, length
    builder.add_loop("pin", "point", a=At("rocker", (0.8, 0, 0)), b=At("base", (1, 0, 0)))
    return builder.build(), {"crank": 1.0, "coupler": -0.5, "rocker": -2.0}


def locomotive() -> tuple[saltus.Model, dict]:
    """Return a coupling rod on three parallel cranks: one more than it needs."""
    builder = ModelBuilder()
    for k in range(3):
        builder.add_link(f"crank_{k}", rod(0.5)).add_joint(
            f"crank_{k}", "revolute", parent="world", child=f"crank_{k}", axis=Z,
            X_PJ=Pose((k, 0, 0)),
        )  # fmt: skip
    builder.add_link("rod", rod(2.0)).add_joint(
        "rod", "revolute", parent="crank_0", child="rod", axis=Z, X_PJ=Pose((0.5, 0, 0))
    )
    for k in (1, 2):
        builder.add_loop(
            f"pin {k}", "point", a=At("rod", (k, 0, 0)), b=At(f"crank_{k}", (0.5, 0, 0))
        )
    return builder.build(), {"crank_0": 1.0, "crank_1": 1.0, "crank_2": 1.0, "rod": -1.0}


@pytest.mark.parametrize("make", [hinge_of_two_points, four_bar_that_floats, locomotive])
def test_loops_that_say_the_same_twice_have_a_motion(make) -> None:
    model, q = make()
    state = saltus.close_loops(model, q)
    run = saltus.simulate(model, state=state, duration=0.2)
    assert run.complete
    worst = max(np.abs(h).max() for row in run.q for h in model.loop_gaps(row).values())
    assert worst < 1e-13
    for k in (5, -1):  # its own rows are good starts
        saltus.simulate(model, state=run.state(k), duration=0.02)


def test_a_loop_that_locks_a_joint_lets_its_body_fly() -> None:
    builder = ModelBuilder().set_gravity((0, 0, 0))
    builder.add_body("base", saltus.Box((0.1, 0.1, 0.1)), mass=2.0)
    builder.add_link("arm", rod(1.0)).add_joint(
        "arm", "revolute", parent="base", child="arm", axis=(0, 1, 0)
    )
    strut = {"a": At("arm", (1, 0, 0)), "b": At("base", (0, 0, 0.7)), "distance": 1.2}
    model = builder.add_loop("strut", "distance", **strut).build()
    q = saltus.close_loops(model, {"arm": -0.3}).q
    for seed in range(10):  # the rate of the arm is the rounding of that of the body
        v = np.random.default_rng(seed).normal(size=7)
        run = saltus.simulate(model, state=saltus.close_loops(model, q, v), duration=0.1)
        np.testing.assert_allclose(run.p[:, :3] - run.p[0, :3], 0, rtol=0, atol=1e-13)
        saltus.simulate(model, state=run.state(-1), duration=0.01)


def test_what_is_kept_stays_or_is_an_error() -> None:
    model = four_bar().build()
    state = saltus.close_loops(model, [1.0, -0.5, -2.0], keep=["joint_0"])
    assert state.q[0] == 1.0
    with pytest.raises(ModelError, match='loop "pin" stays open'):
        saltus.close_loops(model, [1.0, -0.5, -2.0], keep=["joint_0", "joint_1"])


def test_a_crank_that_is_told_drives_its_four_bar() -> None:
    model = four_bar().set_prescribed("joint_0", [0, 10], [1.0, 61.0]).build()  # 6 rad/s
    state = saltus.close_loops(model, [1.0, -0.5, -2.0])
    assert model.velocity(state)[0] == pytest.approx(6.0)
    run = saltus.simulate(model, state=state, duration=1.0, h=0.001)
    np.testing.assert_allclose(run.q[:, 0], 1 + 6 * run.t, rtol=0, atol=1e-12)
    assert run.energy_error < 1e-4  # O(h^2) of the work that the crank does


def test_a_joint_that_is_told_may_be_dry_and_ends_at_its_limit() -> None:
    told = chain([(1, 1), (1, 1)]).set_prescribed("joint_0", [0, 1], [0, 1])
    dry = told.set_friction("joint_0", 1.0).set_friction("joint_1", 0.1).build()
    run = saltus.simulate(dry, state=saltus.close_loops(dry), duration=0.5, progress=False)
    assert np.isfinite(run.p).all()
    stopped = told.set_limit("joint_0", -0.1, 0.1).build()
    with pytest.raises(saltus.StepError, match=r"joint_0 upper limit closes at t = 0\.1 s"):
        saltus.simulate(stopped, state=saltus.close_loops(stopped), duration=0.5, progress=False)


def test_a_truss_with_dry_joints_stands_still() -> None:
    builder = chain([(1, 1), (1, 1)])
    builder.set_friction("joint_0", 0.5).set_friction("joint_1", 0.5)
    builder.add_loop("pin", "point", a=At("rod_1", (1, 0, 0)), b=At("world", (1.2, 0.3, 0)))
    model = builder.build()
    q = saltus.close_loops(model, [0.9, -1.8]).q
    run = saltus.simulate(model, q=q, duration=0.5)
    assert not len(run.fallbacks)
    np.testing.assert_allclose(run.q, np.tile(q, (len(run.t), 1)), rtol=0, atol=1e-13)


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_loops_that_contradict_each_other_have_no_motion(friction: float) -> None:
    builder = chain([(1, 1)]).set_friction("joint_0", friction)
    builder.add_loop("pin", "point", a=At("rod_0", (0.5, 0, 0)), b=At("world", (0.5, 0, 0)))
    builder.set_prescribed("joint_0", function=lambda t: (0.1 * t**2, 0.2 * t))
    model = builder.build()
    with pytest.raises(saltus.StepError):
        saltus.simulate(model, duration=0.5, h=0.01, progress=False)


def test_a_function_cannot_use_the_stepper_that_asks_it() -> None:
    steppers = []

    def told(t: float) -> tuple[float, float]:
        for stepper in steppers:
            stepper.report  # noqa: B018
        return 0.1 * t * t, 0.2 * t

    model = chain([(1, 1)]).set_prescribed("joint_0", function=told).build()
    state = saltus.close_loops(model)
    steppers.append(saltus.Stepper(model, 0.01))
    with pytest.raises(ModelError, match="the stepper is in a step, which asks this function"):
        steppers[0].advance(state)


def test_a_joint_may_mimic_one_that_comes_later_beside_a_ball() -> None:
    builder = ModelBuilder()
    for name, kind, parent, mimic in (
        ("0", "revolute", "world", None),
        ("1", "revolute", "world", None),
        ("2", "revolute", "link_0", Mimic("joint_1", 1.0, 0.0)),
        ("3", "spherical", "link_0", None),
    ):
        builder.add_link(f"link_{name}", saltus.solid_box(1.0, (0.1, 0.1, 0.1)))
        builder.add_joint(
            f"joint_{name}", kind, parent=parent, child=f"link_{name}", axis=(0, 1, 0),
            X_PJ=Pose((0.3, 0, 0)), mimic=mimic,
        )  # fmt: skip
    model = builder.build()
    assert model.n_v == 5
    q = model.random_configuration(np.random.default_rng(1))
    R = [model.pose(q, f"link_{k}").R for k in range(3)]
    np.testing.assert_allclose(R[2], R[0] @ R[1], rtol=0, atol=1e-14)
    run = saltus.simulate(model, q=q, duration=0.5)
    assert run.energy_error < 1e-3
    assert math.isfinite(run.total[-1])


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_what_is_squeezed_is_an_error_and_does_not_sink(restitution: float) -> None:
    """A ball between a piston that is told to come on and a wall."""
    builder = ModelBuilder().set_gravity((0, 0, 0)).set_default_contact(restitution=restitution)
    ball = saltus.Sphere(0.1)
    builder.add_body("piston", ball, mass=1.0, joint="prismatic", axis=(1, 0, 0))
    builder.add_body("ball", ball, mass=1.0, X=Pose((0.35, 0, 0)))
    builder.add_half_space("wall", (-1, 0, 0), -0.6)
    model = builder.set_prescribed("piston", [0, 1, 2], [0, 0.3, 0.6]).build()
    with pytest.raises(saltus.StepError) as caught:
        saltus.simulate(model, state=saltus.close_loops(model), duration=1.5, progress=False)
    rows = caught.value.trajectory.q
    assert model.gaps(rows[-1]).phi.min() > -1e-12


def test_another_root_of_the_arc_is_no_step() -> None:
    """A chain that spins fast for its step: energy jumps from arc to arc are asked about."""
    builder = chain([(1, 1)] * 4)
    model = builder.build()
    for seed in range(6):
        v = np.random.default_rng(seed).normal(scale=12.0, size=4)
        try:
            run = saltus.simulate(model, v=v, duration=2.0, h=0.01, progress=False)
        except saltus.StepError as error:
            run = error.trajectory
        jumps = np.abs(np.diff(run.total)) / np.maximum(run.kinetic[1:], run.kinetic[:-1])
        assert jumps.max() < 0.6  # of nodes; midpoints are held to 0.3


def test_a_linkage_has_the_same_bits_alone_and_in_company() -> None:
    def leg(builder: ModelBuilder, x: float) -> ModelBuilder:
        for name, length, parent, at in (
            ("thigh", 0.4, "world", (x, 0, 1.0)),
            ("shin", 0.5, f"thigh {x}", (0.4, 0, 0)),
        ):
            builder.add_link(f"{name} {x}", rod(length)).add_joint(
                f"{name} {x}", "revolute", parent=parent, child=f"{name} {x}", axis=(0, 1, 0),
                X_PJ=Pose(at),
            )  # fmt: skip
        builder.add_shape(f"shin {x}", saltus.Sphere(0.05), Pose((0.5, 0, 0)))
        return builder.add_loop(
            f"strut {x}", "distance", a=At(f"shin {x}", (0.5, 0, 0)), b=At("world", (x, 0, 1.5)),
            distance=1.1,
        )  # fmt: skip

    alone = leg(ModelBuilder().add_floor(restitution=0.3, friction=0.4), 0.0)
    many = leg(leg(ModelBuilder().add_floor(restitution=0.3, friction=0.4), 0.0), 5.0)
    many.add_body("box", saltus.Box((0.2, 0.2, 0.2)), mass=1.0, X=Pose((10, 0, 1)))
    runs = []
    for builder in (alone, many):
        model = builder.build()
        state = saltus.close_loops(model, {"thigh 0.0": 0.4, "shin 0.0": 0.3})
        runs.append(saltus.simulate(model, state=state, duration=0.3, h=0.01, progress=False))
    assert len(runs[0].impacts) == 0  # until then arcs are the same
    np.testing.assert_allclose(runs[1].q[:, :2], runs[0].q, rtol=0, atol=1e-13)


def test_a_policy_drives_a_linkage() -> None:
    """Before the first step its report has loops that pushed nothing."""
    model = four_bar().add_motor("m", joint="joint_0").build()
    seen = []

    def policy(now: saltus.Moment) -> list[float]:
        seen.append(now.report.loops["pin"])
        return [1.0 + math.sin(now.t)]

    state = saltus.close_loops(model, [1.0, -0.5, -2.0])
    run = saltus.simulate(model, state=state, duration=0.1, h=0.01, control=policy)
    assert run.complete
    np.testing.assert_array_equal(seen[0], np.zeros(3))
    assert np.abs(seen[1]).max() > 0
