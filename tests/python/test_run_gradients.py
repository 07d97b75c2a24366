"""Gradients of runs by what their actuators have; of long ones, whose tapes are kept in parts."""

from __future__ import annotations

import numpy as np
import pytest

import saltus
from saltus import ModelBuilder

NUMBERS = {"drive": (0.7, 0.05, -3.0, -0.2), "tie": (1.3, -0.1, -2.0, -0.4)}
CONTROL = [0.9, -0.4]


def arm(numbers: dict[str, tuple[float, ...]], *, effort: float = 1e3) -> saltus.Model:
    """Return two links in the air: one actuator of one joint, one of both through gears."""
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    upper, lower = builder.joint_names[-2:]
    for name, joints in (("drive", {upper: 2.0}), ("tie", {upper: -0.5, lower: 1.5})):
        gain, *bias = numbers[name]
        builder.add_actuator(name, joints=joints, gain=gain, bias=bias, effort=effort)
    return builder.build()


def run(model: saltus.Model) -> saltus.Trajectory:
    # p of the start is 0 whatever the actuators have
    return saltus.simulate(
        model, [0.3, -0.2], duration=0.3, h=0.02, control=CONTROL, progress=False
    )


def end(model: saltus.Model) -> float:
    made = run(model)
    return float(made.q[-1] @ [1.0, -0.5] + made.p[-1] @ [0.3, 0.8])


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("column", range(4))
def test_a_run_is_differentiated_by_its_actuators(name, column):
    g = run(arm(NUMBERS)).gradient([1.0, -0.5], [0.3, 0.8])

    def cost(x: float) -> float:
        numbers = list(NUMBERS[name])
        numbers[column] += x
        return end(arm(NUMBERS | {name: tuple(numbers)}))

    h = 1e-3  # fourth order: truncation 1e-12, rounding 1e-12
    slope = (8 * (cost(h) - cost(-h)) - cost(2 * h) + cost(-2 * h)) / (12 * h)
    row = list(NUMBERS).index(name)
    assert g.actuators.shape == (2, 4)
    assert abs(slope) > 1e-4
    assert g.actuators[row, column] == pytest.approx(slope, rel=1e-8)


def test_what_pushes_all_it_can_does_not_depend_on_its_gains():
    g = run(arm(NUMBERS, effort=1e-3)).gradient([1.0, -0.5], [0.3, 0.8])
    np.testing.assert_array_equal(g.actuators, 0)


def cart(kp: float, kd: float) -> saltus.Model:
    """Return a cart that a servo holds as a spring and a damper do."""
    builder = ModelBuilder().add_body(
        "cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic", axis=(1, 0, 0)
    )
    return builder.add_position_servo("servo", joint="cart", kp=kp, kd=kd).build()


def test_a_position_servo_by_its_gains():
    def last(kp: float, kd: float) -> saltus.Trajectory:
        return saltus.simulate(cart(kp, kd), duration=1.0, h=0.05, control=[0.7], progress=False)

    (row,) = last(5.0, 0.8).gradient([1.0], [0.0]).actuators

    def slope(dp: float, dd: float) -> float:
        def at(x: float) -> float:
            return float(last(5.0 + x * dp, 0.8 + x * dd).q[-1, 0])

        h = 1e-3
        return (8 * (at(h) - at(-h)) - at(2 * h) + at(-2 * h)) / (12 * h)

    assert row[0] - row[2] == pytest.approx(slope(1, 0), rel=1e-8)
    assert -row[3] == pytest.approx(slope(0, 1), rel=1e-8)


def test_a_run_of_more_steps_than_tapes_are_kept():
    """5000 linear steps: the gradient is that of a power of one step's matrix."""
    model, steps, h = cart(5.0, 0.0), 5000, 0.02
    stepper = saltus.Stepper(model, h=h, record=True)
    stepper.advance(model.state(q=[0.3]))
    A = np.linalg.matrix_power(stepper.derivative().A, steps)
    made = saltus.simulate(model, [0.3], duration=steps * h, h=h, progress=False)
    g = made.gradient([1.0], [0.5])
    # rounding of 5000 steps, and of the power: 5000 eps and some
    np.testing.assert_allclose([g.q[0], g.p[0]], [1.0, 0.5] @ A, rtol=1e-11)
