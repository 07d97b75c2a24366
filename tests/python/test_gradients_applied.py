"""Derivatives by what is applied, and by springs and dampers between points: differences."""

from __future__ import annotations

import numpy as np
import pytest
from test_step_derivatives_friction import difference

import saltus
from saltus import At, ModelBuilder, Wrench

Array = np.ndarray
SPRING = {"stiffness": 40.0, "length": 0.4, "damping": 1.5}
FORCE, QFRC = np.array([1.5, -0.7, 2.0]), np.array([0.4, -0.2, 0.3])
BY_Q, BY_P = np.array([1.0, -0.5, 0.8]), np.array([0.3, 0.8, -0.6])


def arm(**changes: float) -> saltus.Model:
    """Return three links in the air, the last tied to the frame and to the first."""
    builder = saltus.read_urdf(saltus.scenes.chain(3))
    first, *_, last = builder.link_names[1:]
    spring = SPRING | changes
    builder.add_spring(
        "tie", a=At(last, (0.05, 0.02, -0.1)), b=At("frame", (0.5, 0.3, 0)), **spring
    )
    builder.add_spring("loose", a=At(last, (0, 0.1, 0)), b=At(first, (0.1, 0, 0)), damping=0.3)
    return builder.build()


def wrench(force: Array = FORCE) -> dict[str, Wrench]:
    return {arm().links[-1].name: Wrench(force, point=(0.03, 0.05, -0.2))}


def run(model: saltus.Model, force: Array = FORCE, qfrc: Array = QFRC) -> saltus.Trajectory:
    start = model.state([0.5, -0.4, 0.3], [1.0, -2.0, 0.5])
    return saltus.simulate(
        model, state=start, duration=0.3, h=0.02, forces=wrench(force), qfrc=qfrc, progress=False
    )


def cost(made: saltus.Trajectory) -> Array:
    return np.atleast_1d(made.q[-1] @ BY_Q + made.p[-1] @ BY_P)


@pytest.fixture(scope="module")
def gradient() -> saltus.RunGradient:
    return run(arm()).gradient(BY_Q, BY_P, forces=wrench(), qfrc=QFRC)


@pytest.mark.parametrize("name", SPRING)
def test_a_run_by_a_spring_and_its_damper(gradient, name):
    expected = difference(lambda x: cost(run(arm(**{name: SPRING[name] + x}))), 1e-3)[0]
    exact = dict(zip(SPRING, (*gradient.springs["tie"], gradient.dampers["tie"]), strict=True))
    assert abs(expected) > 1e-5
    assert exact[name] == pytest.approx(expected, rel=1e-8)  # arcs to 1e-12, over 1e-3
    assert set(gradient.dampers) == {"tie", "loose"}
    assert set(gradient.springs) == {"tie"}  # the other has no stiffness


@pytest.mark.parametrize("axis", range(3))
def test_a_run_by_the_force_of_a_wrench(gradient, axis):
    (by_force,) = gradient.forces.values()
    assert by_force.shape == (15, 3)
    expected = difference(lambda x: cost(run(arm(), FORCE + x * np.eye(3)[axis])), 1e-3)[0]
    assert by_force[:, axis].sum() == pytest.approx(expected, rel=1e-8, abs=1e-10)


@pytest.mark.parametrize("joint", range(3))
def test_a_run_by_forces_on_coordinates(gradient, joint):
    expected = difference(lambda x: cost(run(arm(), FORCE, QFRC + x * np.eye(3)[joint])), 1e-3)[0]
    assert gradient.qfrc[:, joint].sum() == pytest.approx(expected, rel=1e-8)


def test_a_run_by_its_start_where_forces_are_applied(gradient):
    model = arm()
    start = model.state([0.5, -0.4, 0.3], [1.0, -2.0, 0.5])
    dq, dp = np.random.default_rng(2).normal(size=(2, 3))

    def moved(x: float) -> Array:
        state = saltus.State(0.0, start.q + x * dq, start.p + x * dp)
        made = saltus.simulate(
            model, state=state, duration=0.3, h=0.02, forces=wrench(), qfrc=QFRC, progress=False
        )
        return cost(made)

    expected = difference(moved, 1e-4)[0]  # of 123, and bends
    assert gradient.q @ dq + gradient.p @ dp == pytest.approx(expected, rel=1e-8)


def test_products_of_a_step_by_a_force():
    """Through an impact of a free body that a force pushes off its centre."""
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    builder.add_body("box", saltus.Box((0.1, 0.2, 0.1)), mass=1.0, joint="floating")
    model = builder.set_default_contact(restitution=0.5, friction=0.2).build()
    q = model.normalized([0, 0, 0.27, 0.3, 0.2, 0.1, 0.9])
    start = model.state(q, [1.0, 0.5, -4.0, 1.0, -2.0, 0.5])

    def end(force: Array, **options: bool) -> tuple[saltus.Stepper, saltus.State]:
        stepper = saltus.Stepper(model, h=0.02, **options)
        pushed = {"box": Wrench(force, point=(0.05, 0.1, 0))}
        return stepper, stepper.advance(start, forces=pushed)

    stepper, last = end(FORCE, record=True)
    d = stepper.derivative()
    assert len(d.impacts) == 1
    assert d.forces.shape == (12, 3)
    random = np.random.default_rng(4)
    direction, by_q, by_p = random.normal(size=3), *random.normal(size=(2, 6))
    forwards = np.concatenate(stepper.jvp(dforces=[direction]))
    np.testing.assert_allclose(forwards, d.forces @ direction, atol=1e-15)
    back = stepper.vjp(by_q, by_p).forces
    assert back.shape == (1, 3)
    assert back[0] @ direction == pytest.approx(np.concatenate([by_q, by_p]) @ forwards, abs=1e-14)

    def moved(x: float) -> Array:
        after = end(FORCE + x * direction)[1]
        return np.concatenate([model.difference(last.q, after.q), after.p])

    expected = difference(moved, 1e-3)
    assert np.abs(forwards - expected).max() < 1e-8 * np.abs(expected).max()


def test_what_was_applied_has_to_be_told():
    made = run(arm())
    with pytest.raises(saltus.ModelError, match=r"tell run\.gradient what simulate had as forces="):
        made.gradient(BY_Q, BY_P)
    with pytest.raises(saltus.ModelError, match="forces or qfrc are not those that were applied"):
        made.gradient(BY_Q, BY_P, forces=wrench(2 * FORCE), qfrc=QFRC)
    stepper = saltus.Stepper(arm(), record=True)
    stepper.advance(arm().state(), forces=wrench())
    with pytest.raises(saltus.ModelError, match=r"dforces is 2 by 3; it is 1 by 3, a row for each"):
        stepper.jvp(dforces=np.zeros((2, 3)))
