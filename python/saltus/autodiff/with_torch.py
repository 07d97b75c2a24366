"""A run as a function that PyTorch differentiates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from saltus._core import Model
from saltus.autodiff.rollout import rollout_of


def torch_rollout(model: Model, h: float = 0.01, **options: Any) -> Callable[..., Any]:
    """Make of a model's runs a `torch.autograd.Function`.

    Runs are made in double precision, on the CPU; what comes out has the type and the device of
    `q`.

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
        Where PyTorch is not installed.
    """
    try:
        import torch
    except ImportError as error:
        raise ImportError("torch_rollout needs PyTorch: pip install 'saltus[torch]'") from error
    made = rollout_of(model, h, options)

    def array(x: Any) -> Any:
        return x.detach().to("cpu", torch.float64).numpy()

    def forward(ctx: Any, q: Any, p: Any, control: Any) -> Any:
        rows = made.run(array(q), array(p), array(control))
        ctx.kept = rows, array(control)
        return tuple(torch.from_numpy(x).to(q) for x in rows)

    def backward(ctx: Any, q_hat: Any, p_hat: Any) -> Any:
        rows, control = ctx.kept
        back = made.pull(rows, control, array(q_hat), array(p_hat))
        return tuple(torch.from_numpy(x.copy()).to(q_hat) for x in back)

    once = torch.autograd.function.once_differentiable(backward)
    of_class = {"forward": staticmethod(forward), "backward": staticmethod(once)}
    Run: Any = type("Run", (torch.autograd.Function,), of_class)

    def rollout(q: Any, p: Any, control: Any) -> Any:
        tensors = [torch.as_tensor(x) for x in (q, p, control)]
        return Run.apply(*(x if x.is_floating_point() else x.double() for x in tensors))

    return rollout
