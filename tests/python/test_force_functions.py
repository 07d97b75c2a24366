"""Forces and potentials that are functions: answers, errors, derivatives."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import saltus
from saltus import BodyInertia, JointType, ModelBuilder, ModelError, Pose

H = 0.01


def arm() -> ModelBuilder:
    """Return two rods in a vertical plane."""
    builder = ModelBuilder("arm")
    for name, mass in (("upper", 2.0), ("lower", 1.0)):
        builder.add_link(name, BodyInertia(mass, (0.4, 0, 0), np.diag([0.001, 0.05, 0.05])))
    axis = (0, 1, 0)
    revolute = JointType.revolute
    builder.add_joint("shoulder", revolute, parent="world", child="upper", axis=axis)
    X = Pose((0.8, 0, 0))
    return builder.add_joint("elbow", revolute, parent="upper", child="lower", axis=axis, X_PJ=X)


def damped_by(function, **options) -> saltus.Model:
    return arm().add_force("wind", function, **options).build()


def test_a_force_of_the_user_is_that_of_damping() -> None:
    real = arm().set_damping("elbow", 0.7).build()
    full = damped_by(lambda now: ([-0.7 * now.v[1]], None, [[0, -0.7]]), coordinates=["elbow"])
    bare = damped_by(lambda now: [0, -0.7 * now.v[1]])
    runs = [saltus.simulate(m, q=[0.3, 0.2], duration=1.0, h=H) for m in (real, full, bare)]
    for run in runs[1:]:
        np.testing.assert_allclose(run.q, runs[0].q, atol=1e-12)
        np.testing.assert_allclose(run.work["applied"], runs[0].work["damping"], atol=1e-12)
    assert runs[0].energy_error == pytest.approx(runs[2].energy_error, rel=1e-6)


def test_a_force_of_time_is_asked_in_the_middle_of_steps() -> None:
    """Order 2 needs the middle: p' = sin t from rest, the midpoint rule's sum."""
    builder = ModelBuilder("cart").set_gravity((0, 0, 0))
    builder.add_body("cart", saltus.Sphere(0.1), mass=1.0, joint="prismatic")
    model = builder.add_force("push", lambda now: [math.sin(now.t)]).build()
    run = saltus.simulate(model, duration=1.0, h=H)
    middles = np.sin((np.arange(100) + 0.5) * H).cumsum() * H
    np.testing.assert_allclose(run.p[1:, 0], middles, atol=1e-14)


class Storm(Exception):
    """An exception of the user's own."""


def test_an_exception_comes_through_and_leaves_the_state() -> None:
    calm = [True]

    def wind(now: saltus.ForceMoment) -> np.ndarray:
        if not calm[0]:
            raise Storm(f"at {now.t}")
        return 0 * now.v

    model = damped_by(wind)
    stepper = saltus.Stepper(model, h=H)
    state = stepper.advance(model.state([0.1, 0.2]))
    before = pickle.dumps(state)
    calm[0] = False
    with pytest.raises(Storm, match=r"at 0.015"):
        stepper.advance(state)
    assert pickle.dumps(state) == before
    calm[0] = True
    expected = saltus.Stepper(model, h=H).advance(state)
    np.testing.assert_allclose(stepper.advance(state).q, expected.q, atol=1e-15)


def test_an_exception_ends_its_own_run_of_a_batch() -> None:
    def wind(now: saltus.ForceMoment) -> np.ndarray:
        if now.q[0] > 1.0:
            raise Storm(f"beyond at {now.q[0]:.2f}")
        return 0 * now.v

    model = damped_by(wind)
    q = np.array([[0.1, 0.2], [1.5, 0.0], [0.3, 0.2]])
    with pytest.warns(RuntimeWarning, match="1 of 3 runs failed, see failures; run 1: .*beyond"):
        batch = saltus.simulate_batch(model, q, duration=0.1, h=H)
    assert list(batch.complete) == [True, False, True]
    assert "Storm: beyond at 1.5" in batch.failures[1]
    for k in (0, 2):
        alone = saltus.simulate(model, q=q[k], duration=0.1, h=H)
        np.testing.assert_array_equal(batch[k].q, alone.q)
    with pytest.raises(Storm, match="beyond") as caught:
        saltus.simulate_batch(model, q, duration=0.1, h=H, on_failure="stop")
    assert len(caught.value.trajectory) == 1


WRONG = {
    "Q_v": (lambda now: (-0.2 * now.v, None, 0.2 * np.eye(2)), r"Q_v\[0, 0\] is 0\.2, .* -0\.2"),
    "Q_q": (
        lambda now: (np.sin(now.q), np.diag(np.sin(now.q)), None),
        r"Q_q\[0, 0\] is .*, and differences say",
    ),
    "Q_q of another": (
        lambda now: ([now.q[1], 0], [[0, 0], [0, 0]], None),
        r"Q_q\[0, 1\] is 0, and differences say 1",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_derivative_is_named_at_the_first_use(name: str) -> None:
    function, message = WRONG[name]
    model = damped_by(function)
    for _ in range(2):  # each time
        with pytest.raises(ModelError, match='force "wind": ' + message):
            saltus.Stepper(model, h=H).advance(model.state())
    with pytest.raises(ModelError, match=message):
        saltus.simulate_batch(model, np.zeros((2, 2)), duration=0.1, h=H)


@pytest.mark.parametrize("which", ["gradient", "hessian"])
def test_a_wrong_derivative_of_a_potential_is_named_at_the_first_use(which: str) -> None:
    parts = well()
    right = parts[which]
    parts[which] = lambda q: 1.1 * np.array(right(q))
    model = arm().add_potential("well", **parts).build()
    words = "gradient" if which == "gradient" else "Hessian"
    with pytest.raises(ModelError, match=f'potential "well": {words}.*, and differences say'):
        saltus.simulate(model, q=[0.1, 0.4], duration=0.1)
    with pytest.raises(ModelError, match=f'potential "well": {words}'):
        saltus.equilibrium(model, q=[0.1, 0.4])


def test_kinks_and_what_a_function_refuses_are_no_wrong_derivatives() -> None:
    """Starts on a kink, at the border of where the function is, and with a jump nearby."""

    def stop(now: saltus.ForceMoment) -> tuple:
        deep = np.minimum(now.q, 0.0)
        return -50 * deep, -50 * np.diag((now.q < 0).astype(float)), None

    def roots(now: saltus.ForceMoment) -> tuple:
        if now.q[0] < 0.5:
            raise Storm("no root")
        return [math.sqrt(now.q[0] - 0.5), 0], [[0.5 / math.sqrt(now.q[0] - 0.5), 0], [0, 0]], None

    def dry(now: saltus.ForceMoment) -> tuple:
        return -0.1 * np.sign(now.v), None, np.zeros((2, 2))

    for function, q in ((stop, [0.0, 0.0]), (roots, [0.5, 0.0]), (dry, [0.0, 0.0])):
        model = damped_by(function)
        saltus.Stepper(model, h=1e-4).advance(model.state(q, [1.0, 1.0]))


def test_a_look_at_derivatives_is_taken_once() -> None:
    calls = []

    def wind(now: saltus.ForceMoment) -> tuple:
        calls.append(now.t)
        return -0.2 * now.v, None, -0.2 * np.eye(2)

    model = damped_by(wind)
    saltus.simulate(model, duration=0.01, h=H)
    first = len(calls)
    saltus.simulate(model, duration=0.01, h=H)
    assert len(calls) - first < first / 2


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (lambda now: [1.0], 'force "wind" returned Q of 1 numbers; it pushes 2 coordinates'),
        (lambda now: [0, math.inf], r'force "wind" returned Q\[1\] = inf at t = 0.005 s'),
        (lambda now: "gale", "returned 'gale' as Q, which are no numbers"),
        (lambda now: None, "returned None as Q"),
        (lambda now: (now.v, None), "returned a tuple of 2"),
        (lambda now: (now.v, np.zeros((2, 3)), None), r"Q_q of shape \(2, 3\); it is \(2, 2\)"),
        (lambda now: (now.v, None, [[0, 0], [0, math.nan]]), r"Q_v\[1, 1\] = nan"),
        (lambda now: np.zeros((2, 2)), r"returned Q of shape \(2, 2\)"),
    ],
)
def test_wrong_answers_are_named(answer, message: str) -> None:
    model = damped_by(answer)
    with pytest.raises(ModelError, match=message):
        saltus.Stepper(model, h=H).advance(model.state())


def test_wrong_forces_are_named() -> None:
    with pytest.raises(
        ModelError, match='pushes coordinate "knee", which does not exist; they are'
    ):
        damped_by(lambda now: [0], coordinates=["knee"])
    with pytest.raises(ModelError, match='names coordinate "elbow" twice'):
        damped_by(lambda now: [0, 0], coordinates=["elbow", "elbow"])
    with pytest.raises(
        TypeError, match=r"add_force\(\) is given function = 3 \(int\), which is no function"
    ):
        damped_by(3)
    with pytest.raises(TypeError, match="its force 'wind' is a function"):
        pickle.dumps(damped_by(lambda now: now.v))


def well(stiffness: float = 5.0) -> dict:
    return {
        "value": lambda q: stiffness * math.cosh(q[1]),
        "gradient": lambda q: [0, stiffness * math.sinh(q[1])],
        "hessian": lambda q: [[0, 0], [0, stiffness * math.cosh(q[1])]],
    }


def test_a_potential_of_the_user_is_part_of_the_energy() -> None:
    model = arm().add_potential("well", **well()).build()
    saltus.check_derivatives("well", model)
    L, plain = model.lagrangian([0.1, 0.4], [0, 0]), arm().build().lagrangian([0.1, 0.4], [0, 0])
    assert L.value - plain.value == pytest.approx(-5 * math.cosh(0.4))
    assert L.L_q[1] - plain.L_q[1] == pytest.approx(-5 * math.sinh(0.4))
    assert L.L_qq[1, 1] - plain.L_qq[1, 1] == pytest.approx(-5 * math.cosh(0.4))
    errors = []
    for h in (0.01, 0.005):
        run = saltus.simulate(model, q=[0.3, 0.5], duration=2.0, h=h)
        errors.append(run.energy_error)
    assert errors[0] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.3)
    with pytest.raises(ModelError, match='third derivatives, which potential "well" does not give'):
        saltus.Stepper(model, law="compensated")
    with pytest.raises(TypeError, match="its potential 'well' is a function"):
        pickle.dumps(model)


def test_wrong_potentials_are_named() -> None:
    functions = well()
    for name, answer, message in [
        ("value", lambda q: [1, 2], "returned 2 numbers as its value"),
        ("gradient", lambda q: [0], "returned a gradient of 1 by 1 numbers; it is 2 by 1"),
        ("hessian", lambda q: np.zeros((2, 3)), "returned a Hessian of 2 by 3 numbers"),
        ("gradient", lambda q: [0, math.nan], "returned a gradient that is not finite"),
    ]:
        model = arm().add_potential("well", **(functions | {name: answer})).build()
        with pytest.raises(ModelError, match=f'potential "well" {message}'):
            model.lagrangian([0.1, 0.2], [0.0, 0.0])


def test_derivatives_that_are_wrong_are_told_with_their_numbers() -> None:
    model = arm().build()

    def drag(now: saltus.ForceMoment, factor: float) -> tuple:
        v = now.v[1]
        return [0, -(v**2)], None, [[0, 0], [0, -factor * v]]

    saltus.check_derivatives(lambda now: drag(now, 2), model)
    message = r'force "function": Q_v\[1, 1\] is .*, and differences say .* with order'
    with pytest.raises(ModelError, match=message):
        saltus.check_derivatives(lambda now: drag(now, 1), model)
    with pytest.raises(ModelError, match="returns Q alone"):
        saltus.check_derivatives(lambda now: now.v, model)
    with pytest.raises(ModelError, match='no force or potential "gust"; there are none'):
        saltus.check_derivatives("gust", model)
    wrong = well() | {"hessian": lambda q: [[0, 0], [0, 1]]}
    with pytest.raises(ModelError, match=r'potential "well": Hessian\[1, 1\] is 1'):
        saltus.check_derivatives("well", arm().add_potential("well", **wrong).build())
    sloped = well() | {"gradient": lambda q: [0.5, 5 * math.sinh(q[1])]}
    with pytest.raises(ModelError, match=r'potential "well": gradient\[0\] is 0.5'):
        saltus.check_derivatives("well", arm().add_potential("well", **sloped).build())
