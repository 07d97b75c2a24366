"""A run as a function that JAX differentiates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from saltus._core import Model
from saltus.autodiff.rollout import rollout_of


def jax_rollout(model: Model, h: float = 0.01, **options: Any) -> Callable[..., Any]:
    """Make of a model's runs a function with a `jax.custom_vjp`.

    It works under `jit`, `grad` and, run by run, `vmap`. Runs are made in double precision; without
    `jax.config.update("jax_enable_x64", True)` JAX keeps seven digits of them.

    Parameters
    ----------
    model : Model
    h : float
        [s] time step.
    **options
        Further options of `Stepper`.

    Returns
    -------
    callable
        `(q, p, control)` to `(q_rows, p_rows)`: the state at the start, (n_q,) and (n_v,), and
        control (steps, n_u), a row for each step; the states of all rows, (steps + 1, n_q) and
        (steps + 1, n_v). p is the momentum, `model.state(q, v).p`.

    Raises
    ------
    ImportError
        Where JAX is not installed.
    """
    try:
        import jax
        import jax.numpy as jnp
    except ImportError as error:
        raise ImportError("jax_rollout needs JAX: pip install 'saltus[jax]'") from error
    made = rollout_of(model, h, options)

    def float_type() -> Any:
        return jnp.zeros(0).dtype

    def shapes(*of: tuple[int, ...]) -> tuple[Any, ...]:
        return tuple(jax.ShapeDtypeStruct(shape, float_type()) for shape in of)

    def numpy_call(f: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function of arrays of doubles as one of JAX's arrays."""

        def call(*arrays: Any) -> Any:
            out = f(*(np.array(x, dtype=float) for x in arrays))
            return tuple(np.asarray(x, dtype=float_type()) for x in out)

        return call

    def forward(q: Any, p: Any, control: Any) -> Any:
        rows = len(control) + 1
        return jax.pure_callback(
            numpy_call(made.run),
            shapes((rows, model.n_q), (rows, model.n_v)),
            q,
            p,
            control,
            vmap_method="sequential",
        )

    def remember(q: Any, p: Any, control: Any) -> Any:
        rows = forward(q, p, control)
        return rows, (rows, control)

    def pull(kept: Any, hats: Any) -> Any:
        (q, p), control = kept
        return jax.pure_callback(
            numpy_call(lambda q, p, u, q_hat, p_hat: made.pull((q, p), u, q_hat, p_hat)),
            shapes((model.n_q,), (model.n_v,), control.shape),
            q,
            p,
            control,
            *hats,
            vmap_method="sequential",
        )

    rollout = jax.custom_vjp(forward)
    rollout.defvjp(remember, pull)

    def checked(q: Any, p: Any, control: Any) -> Any:
        arrays = [jnp.asarray(x, dtype=float_type()) for x in (q, p, control)]
        made.check(*arrays)
        return rollout(*arrays)

    return checked
