"""Runs as functions that PyTorch and JAX differentiate, each of which is an extra.

`saltus.autodiff.torch_rollout` and `jax_rollout` make one of a model: from the state at the start
and the controls of each step to the states of all rows, exact through impacts.
"""

from saltus.autodiff.with_jax import jax_rollout
from saltus.autodiff.with_torch import torch_rollout

__all__ = ["jax_rollout", "torch_rollout"]
