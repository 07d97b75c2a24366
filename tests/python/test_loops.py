"""Loops and couplings: against reference values, closed forms, and what redundant ones share."""

from __future__ import annotations

import math
import pickle
from itertools import pairwise

import numpy as np
import pytest
from tests.python.test_forces import GOLDEN, H, assert_rows

import saltus
from saltus import At, BodyInertia, JointType, ModelBuilder, ModelError, Pose

Z = (0.0, 0.0, 1.0)


def chain(rods: list[tuple[float, float]]) -> ModelBuilder:
    """Return rods (mass, length) in a chain from the world's origin, in the plane z = 0."""
    builder = ModelBuilder("chain").set_gravity((0, -9.81, 0))
    parent, at = "world", 0.0
    for k, (m, length) in enumerate(rods):
        moment = m * length**2 / 12
        builder.add_link(
            f"rod_{k}", BodyInertia(m, (length / 2, 0, 0), np.diag([0, moment, moment]))
        )
        builder.add_joint(
            f"joint_{k}",
            JointType.revolute,
            parent=parent,
            child=f"rod_{k}",
            axis=Z,
            X_PJ=Pose((at, 0, 0)),
        )
        parent, at = f"rod_{k}", length
    return builder


def four_bar(**loop: object) -> ModelBuilder:
    builder = chain([(1, 0.4), (2, 1), (1.5, 0.8)])
    return builder.add_loop(
        "pin", "point", a=At("rod_2", (0.8, 0, 0)), b=At("world", (1, 0, 0)), **loop
    )


def test_a_four_bar_is_the_reference() -> None:
    model = four_bar().build()
    start = GOLDEN["fourbar"]["start"]
    run = saltus.simulate(model, q=start["q"], v=start["v"], duration=2.0, h=H)
    # 1e-11: two solvers of the reference agree to 1e-12 at t = 2
    assert_rows(run, GOLDEN["fourbar"]["rows"], 1e-11)
    for row in run.q:
        assert np.abs(model.loop_gaps(row)["pin"]).max() < 1e-14


def crank() -> saltus.Model:
    builder = chain([(1, 0.3), (2, 1)])
    builder.add_link("slider", BodyInertia(1.5, (0, 0, 0), np.zeros((3, 3))))
    builder.add_joint("tip", JointType.fixed, parent="rod_1", child="slider", X_PJ=Pose((1, 0, 0)))
    builder.add_shape("slider", saltus.Sphere(0.01))
    builder.add_half_space("wall", (-1, 0, 0), -1.26)  # the slider's centre stops at 1.25
    # a plane whose normal, the z axis of b, is along y
    R = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])
    return builder.add_loop("guide", "on_plane", a=At("slider"), b=At("world", R=R)).build()


def test_a_slider_crank_hits_a_wall_as_the_reference_does() -> None:
    golden = GOLDEN["crank"]
    model = crank()
    start = golden["start"]
    run = saltus.simulate(model, q=start["q"], v=start["v"], duration=1.0, h=H)
    assert len(run.impacts) == 1
    # 1e-11: the time is a quotient by the rate of the gap, about 5 m/s
    assert run.impacts["t"][0] == pytest.approx(golden["impact"], abs=1e-11)
    assert run.impulses["lambda"][0] == pytest.approx(golden["impulse"], rel=1e-11)
    assert_rows(run, golden["rows"], 1e-11)


def test_a_loop_is_of_second_order() -> None:
    model = four_bar().build()
    start = GOLDEN["fourbar"]["start"]
    exact = GOLDEN["fourbar"]["continuum"][1]
    errors = []
    for h in (0.01, 0.005, 0.0025):
        run = saltus.simulate(model, q=start["q"], v=start["v"], duration=0.5, h=h)
        errors.append(np.abs(run.q[-1] - exact["q"]).max())
    for coarse, fine in pairwise(errors):
        assert 3.5 < coarse / fine < 4.5


@pytest.mark.slow
def test_a_four_bar_keeps_its_energy_and_stays_closed_over_1e5_steps() -> None:
    model = four_bar().build()
    start = GOLDEN["fourbar"]["start"]
    run = saltus.simulate(
        model, q=start["q"], v=start["v"], duration=1000.0, h=H, record_every=10, progress=False
    )
    energy = run.kinetic + run.potential
    band = (energy - energy[0]) / run.kinetic[0]
    # the band of an independent program; each tenth of the run has it
    for tenth in np.array_split(band, 10):
        assert -1.13e-2 < tenth.min() < -1.0e-2
        assert 5.4e-3 < tenth.max() < 5.8e-3
    # an angle of 7705 rad is rounded to 1e-12
    worst = max(np.abs(model.loop_gaps(q)["pin"]).max() for q in run.q[::100])
    assert worst < 1e-11


def test_redundant_loops_share_the_load_and_change_nothing() -> None:
    one = four_bar().build()
    two = (
        four_bar()
        .add_loop("second pin", "point", a=At("rod_2", (0.8, 0, 0)), b=At("world", (1, 0, 0)))
        .build()
    )
    start = GOLDEN["fourbar"]["start"]
    states = [m.state(start["q"], start["v"]) for m in (one, two)]
    steppers = [saltus.Stepper(m, H) for m in (one, two)]
    for _ in range(20):
        states = [s.advance(x) for s, x in zip(steppers, states, strict=True)]
    np.testing.assert_allclose(states[0].q, states[1].q, rtol=0, atol=1e-12)
    alone = steppers[0].report.loops["pin"]
    shared = steppers[1].report.loops
    np.testing.assert_allclose(shared["pin"], alone / 2, rtol=0, atol=1e-10)
    np.testing.assert_allclose(shared["second pin"], alone / 2, rtol=0, atol=1e-10)


def test_the_force_of_a_loop_is_the_weight_that_it_carries() -> None:
    """A rod hinged at one end, its other end hung on a point of the world: half its weight."""
    builder = chain([(2, 1)])
    model = builder.add_loop("hook", "point", a=At("rod_0", (1, 0, 0)), b=At("world", (1, 0, 0)))
    stepper = saltus.Stepper(model.build(), H)
    state = stepper.advance(model.build().state())
    np.testing.assert_allclose(stepper.report.loops["hook"] / H, [0, 9.81, 0], atol=1e-12)
    np.testing.assert_array_equal(state.q, [0])


def test_a_weld_is_one_body() -> None:
    """Two free boxes welded together fly as one body of the same inertia."""
    builder = ModelBuilder("pair").set_gravity((0, 0, 0))
    builder.add_body("a", saltus.Box((0.1, 0.2, 0.3)), mass=1.0)
    builder.add_body("b", saltus.Box((0.3, 0.1, 0.1)), mass=2.0)
    builder.add_loop("weld", saltus.LoopType.weld, a=At("a", (0.1, 0, 0)), b=At("b", (-0.1, 0, 0)))
    model = builder.build()
    state = saltus.close_loops(
        model, q={"a": [0, 0, 0, 0, 0, 0, 1]}, v={"a": [0.1, 0, 0, 1.0, 2.0, 0.5]}, keep=["a"]
    )
    np.testing.assert_allclose(model.loop_gaps(state.q)["weld"], 0, atol=1e-14)
    run = saltus.simulate(model, state=state, duration=1.0, h=0.001)
    assert max(np.abs(model.loop_gaps(q)["weld"]).max() for q in run.q) < 1e-13

    one = ModelBuilder("one").set_gravity((0, 0, 0))
    one.add_body("a", saltus.Box((0.1, 0.2, 0.3)), mass=1.0)
    shape, mass = saltus.Box((0.3, 0.1, 0.1)), 2.0
    one.add_body("b", shape, mass=mass, parent="a", joint=JointType.revolute, X=Pose((0.2, 0, 0)))
    rigid = one.build()
    reference = saltus.simulate(
        rigid.builder().add_loop("weld", "weld", a=At("a"), b=At("b", (-0.2, 0, 0))).build(),
        q={"a": [0, 0, 0, 0, 0, 0, 1]},
        v={"a": [0.1, 0, 0, 1.0, 2.0, 0.5]},
        duration=1.0,
        h=0.001,
    )
    np.testing.assert_allclose(run.q[-1][:7], reference.q[-1][:7], atol=1e-5)


def test_a_distance_is_a_rod_without_mass() -> None:
    """A free ball on a massless rod is a spherical pendulum: small swings of 2 pi sqrt(l / g)."""
    builder = ModelBuilder().add_body("bob", saltus.Sphere(0.01), mass=1.0)
    builder.add_loop("rod", "distance", a=At("bob"), b=At("world", (0, 0, 1)), distance=1.0)
    model = builder.build()
    angle = 0.01
    q = {"bob_x": math.sin(angle), "bob_z": 1 - math.cos(angle)}
    period = 2 * math.pi * math.sqrt(1 / 9.81)
    run = saltus.simulate(model, q=q, duration=period, h=period / 1000)
    # 1 - a^2 / 16 of the pendulum, (h w)^2 / 24 of the rule
    assert run.q[-1][0] == pytest.approx(math.sin(angle), rel=1e-6)


def test_a_coupling_of_degree_one_is_a_mimic_joint() -> None:
    def two(**joint: object) -> ModelBuilder:
        builder = ModelBuilder().set_gravity((0, -9.81, 0))
        for name, options in (("a", {}), ("b", joint)):
            builder.add_link(name, BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
            builder.add_joint(
                name, JointType.revolute, parent="world", child=name, axis=Z, **options
            )
        return builder

    coupled = two().add_coupling("b", of="a", polynomial=(0.1, 2.0)).build()
    mimic = two(mimic=saltus.Mimic("a", 2.0, 0.1)).build()
    assert coupled.loop_names == ["b coupling"]
    runs = [
        saltus.simulate(coupled, state=saltus.close_loops(coupled, {"a": 0.4}, keep=["a"]),
                        duration=1.0, h=H),
        saltus.simulate(mimic, q={"a": 0.4}, duration=1.0, h=H),
    ]  # fmt: skip
    np.testing.assert_allclose(runs[0].q[:, 0], runs[1].q[:, 0], atol=1e-12)
    np.testing.assert_allclose(runs[0].q[:, 1], 2 * runs[0].q[:, 0] + 0.1, atol=1e-14)


def test_a_coupling_may_be_curved() -> None:
    """x_b = x_a^2 on two sliders is a bead on a parabola: its energy is that of the bead."""
    builder = ModelBuilder().set_gravity((0, -9.81, 0))
    builder.add_link("x", BodyInertia(1e-9, (0, 0, 0), np.zeros((3, 3))))
    builder.add_link("bead", BodyInertia(1, (0, 0, 0), np.zeros((3, 3))))
    slide = JointType.prismatic
    builder.add_joint("x", slide, parent="world", child="x", axis=(1, 0, 0))
    builder.add_joint("y", slide, parent="x", child="bead", axis=(0, 1, 0))
    model = builder.add_coupling("y", of="x", polynomial=(0, 0, 1)).build()
    state = saltus.close_loops(model, {"x": 1.0}, keep=["x"])
    np.testing.assert_allclose(state.q, [1, 1], atol=1e-15)
    run = saltus.simulate(model, state=state, duration=2.0, h=0.002)
    np.testing.assert_allclose(run.q[:, 1], run.q[:, 0] ** 2, atol=1e-14)
    assert run.energy_error < 1e-4
    assert run.q[:, 0].min() == pytest.approx(-1.0, abs=1e-3)


def test_a_rank_that_changes_is_an_error_and_no_motion() -> None:
    """A parallelogram that folds flat may go on as one or as an anti-parallelogram."""
    builder = chain([(1, 1), (1, 2), (5, 1)])
    builder.add_loop("pin", "point", a=At("rod_2", (1, 0, 0)), b=At("world", (2, 0, 0)))
    model = builder.build()
    state = saltus.close_loops(model, [math.pi / 2, -math.pi / 2, -math.pi / 2], keep=["joint_0"])
    flat = [0.0, 0.0, math.pi]
    with pytest.raises(ModelError, match='loop "pin" is where two motions branch'):
        saltus.simulate(model, q=flat, duration=0.1)
    run = saltus.simulate(model, state=state, duration=0.2)  # away from there all is well
    assert run.complete


def test_models_with_loops_survive_a_pickle_and_a_prefix() -> None:
    model = four_bar().build()
    again = pickle.loads(pickle.dumps(model))
    start = GOLDEN["fourbar"]["start"]
    runs = [
        saltus.simulate(m, q=start["q"], v=start["v"], duration=0.1, h=H) for m in (model, again)
    ]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)
    both = ModelBuilder().add(model, "left_").add(model, "right_").build()
    assert both.loop_names == ["left_pin", "right_pin"]
    run = saltus.simulate(
        both, q=[*start["q"], *start["q"]], v=[*start["v"], *start["v"]], duration=0.1, h=H
    )
    # gravity of the new builder is along z: the plane's motion has none
    np.testing.assert_allclose(run.q[:, :3], run.q[:, 3:], rtol=0, atol=1e-12)
