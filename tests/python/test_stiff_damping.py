"""Damping that stops a joint within a step: no zigzag, the factor of the rule, its work."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.test_forces import H, arm, pendulum

import saltus


def wheel(damping: float) -> saltus.Model:
    """Return a wheel of 1 kg m^2 that nothing but damping acts on."""
    return pendulum(damping=damping).set_gravity((0, 0, 0)).build()


@pytest.mark.parametrize("z", [0.5, 3.9, 4.1, 10.0, 1e4])
def test_the_factor_of_a_step(z: float) -> None:
    model = wheel(z / H)
    run = saltus.simulate(model, v=[1.0], duration=3 * H, h=H)
    beta = 0.5 if z <= 4 else 1 - 1 / 2 ** np.ceil(np.log2(z))
    factor = (1 - (1 - beta) * z) / (1 + beta * z)
    np.testing.assert_allclose(run.v[1:, 0], factor ** np.arange(1, 4), rtol=1e-9, atol=1e-13)
    # the distance to rest is p / d, whatever the rule
    far = saltus.simulate(model, v=[1.0], duration=2000 * H, h=H)
    assert far.q[-1, 0] == pytest.approx(H / z, rel=1e-9)
    # what damping took is all there was
    assert far.work["damping"][-1] == pytest.approx(-0.5, rel=1e-9)
    assert model.stiff_joints(H) == (["swing"] if z > 4 else [])


def test_an_arm_in_tar_creeps_without_zigzag() -> None:
    builder = arm()
    for joint in ("shoulder", "elbow"):
        builder.set_damping(joint, 1e4)
    model = builder.build()
    assert model.stiff_joints(H) == ["shoulder", "elbow"]
    run = saltus.simulate(model, q=[0.3, 0.5], v=[1.0, -1.0], duration=60 * H, h=H)
    signs = np.sign(run.v[1:])
    assert np.abs(np.diff(signs, axis=0)).sum(axis=0).max() <= 2  # once
    fine = saltus.simulate(model, q=[0.3, 0.5], v=[1.0, -1.0], duration=60 * H, h=H / 100)
    # of first order: h d p / d^2, about 1e-5
    np.testing.assert_allclose(run.q[-1], fine.q[-1], rtol=0, atol=2e-5)
    assert run.energy_error < 1e-3


def test_impacts_and_limits_go_on_as_before() -> None:
    model = pendulum(lower=-0.5, upper=0.5, damping=2000.0).build()
    run = saltus.simulate(model, q=[0.4], v=[100.0], duration=1.0, h=H)
    assert run.q.max() <= 0.5 + 1e-9
    assert run.complete


def test_steps_that_are_none_are_named() -> None:
    with pytest.raises(saltus.ModelError, match=r"h = -1 s; a step is positive"):
        wheel(1.0).stiff_joints(-1.0)
