"""Runs that PyTorch and JAX differentiate, by their own checks of gradients."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import saltus
from saltus import ModelBuilder, Pose, autodiff
from saltus.autodiff.rollout import rollout_of

STEPS, H = 12, 0.02


def bouncer() -> saltus.Model:
    """Return a ball on a slide that a motor pushes, and a floor that it hits in the run."""
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    builder.add_body(
        "ball", saltus.Sphere(0.1), mass=1.3, joint="prismatic", axis=(0, 0, 1), X=Pose((0, 0, 0.3))
    )
    return builder.set_default_contact(restitution=0.7).add_motor("push", joint="ball").build()


def tumbler() -> saltus.Model:
    """Return a body that flies: its quaternion has four numbers and three freedoms."""
    builder = ModelBuilder()
    return builder.add_body("box", saltus.Box((0.1, 0.2, 0.3)), mass=1.3, joint="floating").build()


def inputs(model: saltus.Model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(3)
    control = rng.normal(size=(STEPS, model.n_u))
    if model.n_q == 1:
        return np.zeros(1), np.array([-2.6]), control
    q = model.integrate(model.neutral(), rng.normal(size=model.n_v))
    return q, 0.3 * rng.normal(size=model.n_v), control


MODELS = pytest.mark.parametrize("make", [bouncer, tumbler])


@MODELS
def test_the_adjoint_is_that_of_differences(make):
    model = make()
    made = rollout_of(model, H, {})
    arrays = inputs(model)
    rng = np.random.default_rng(5)
    weights = [rng.normal(size=(STEPS + 1, n)) for n in (model.n_q, model.n_v)]
    rows = made.run(*arrays)
    if make is bouncer:
        assert rows[1][0, 0] < 0 < rows[1][-1, 0]  # it hit the floor
    back = made.pull(rows, arrays[2], *weights)
    directions = [rng.normal(size=x.shape) for x in arrays]

    def cost(x: float) -> float:
        moved = [a + x * d for a, d in zip(arrays, directions, strict=True)]
        return float(sum(np.sum(w * y) for w, y in zip(weights, made.run(*moved), strict=True)))

    step = 1e-4  # of a rule of fourth order: truncation 1e-14, rounding 1e-11
    slope = (8 * (cost(step) - cost(-step)) - cost(2 * step) + cost(-2 * step)) / (12 * step)
    along = sum(float(np.sum(b * d)) for b, d in zip(back, directions, strict=True))
    assert along == pytest.approx(slope, rel=1e-7)


@MODELS
def test_jax_checks_its_gradients(make):
    jax = pytest.importorskip("jax", reason="JAX is not installed: pip install 'saltus[jax]'")
    from jax.test_util import check_grads

    with jax.enable_x64(True):
        model = make()
        rollout = autodiff.jax_rollout(model, H)
        # second order with steps of 1e-5, of numbers about 1: 1e-9, and 1e-10 by rounding
        check_grads(rollout, inputs(model), order=1, modes=["rev"], eps=1e-5, atol=1e-6, rtol=1e-6)


def test_jax_compiles_and_maps_runs():
    jax = pytest.importorskip("jax", reason="JAX is not installed: pip install 'saltus[jax]'")
    with jax.enable_x64(True):
        model = bouncer()
        rollout = autodiff.jax_rollout(model, H)
        q, p, control = inputs(model)

        def height(p):
            return rollout(q, p, control)[0][-1, 0]

        slopes = jax.jit(jax.vmap(jax.grad(height)))(np.stack([p, 0.9 * p]))
        made = rollout_of(model, H, {})
        for k, start in enumerate((p, 0.9 * p)):
            q_hat = np.zeros((STEPS + 1, 1))
            q_hat[-1] = 1
            expected = made.pull(made.run(q, start, control), control, q_hat, 0 * q_hat)[1]
            np.testing.assert_allclose(slopes[k], expected, rtol=1e-14)


@MODELS
def test_torch_checks_its_gradients(make):
    torch = pytest.importorskip(
        "torch", reason="PyTorch is not installed: pip install 'saltus[torch]'"
    )
    model = make()
    rollout = autodiff.torch_rollout(model, H)
    # of no controls there is nothing to check, and gradcheck refuses arrays without numbers
    tensors = [
        torch.tensor(x, dtype=torch.float64, requires_grad=x.size > 0) for x in inputs(model)
    ]
    assert torch.autograd.gradcheck(rollout, tensors, eps=1e-6, atol=1e-6, rtol=1e-5)


def test_what_is_wrong_is_told():
    made = rollout_of(bouncer(), H, {})
    with pytest.raises(saltus.ModelError, match=r"control has shape \(12, 2\); it is \(steps, 1\)"):
        made.run(np.zeros(1), np.zeros(1), np.zeros((12, 2)))
    with pytest.raises(saltus.ModelError, match=r"q has shape \(2,\)"):
        made.run(np.zeros(2), np.zeros(1), np.zeros((12, 1)))
    with pytest.raises(saltus.ModelError, match="h = -1; it must be positive"):
        rollout_of(bouncer(), -1.0, {})
    with pytest.raises(TypeError, match="makes a Model of it"):
        rollout_of("model", H, {})  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["jax", "torch"])
def test_the_extra_that_is_missing_is_named(name, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=rf"pip install 'saltus\[{name}\]'"):
        getattr(autodiff, f"{name}_rollout")(bouncer())
