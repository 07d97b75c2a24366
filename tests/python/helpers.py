"""Commands and random numbers that several test files use."""

from __future__ import annotations

import _thread
import builtins
import os
import subprocess
import sys
from collections.abc import Callable

import numpy as np

import saltus


def random_state(model: saltus.Model, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(-1, 1, model.n_q), rng.uniform(-1, 1, model.n_q)


def run_cli(*arguments: object, **options: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "saltus", *map(str, arguments)]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    return subprocess.run(
        command, capture_output=True, text=True, env=environment, timeout=120, **options
    )


def interrupting(parts: list[float], at: int) -> Callable[[float], None]:
    """Return a progress that notes its parts, and presses Ctrl-C at the one of that number."""

    def tell(part: float) -> None:
        parts.append(part)
        if len(parts) == at:
            _thread.interrupt_main()

    return tell


def hide_scipy(monkeypatch) -> None:
    """Let no import find SciPy."""
    real = builtins.__import__

    def without(name, *rest):
        if name.startswith("scipy"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)


def central_differences(function, x: np.ndarray, step: float = 1e-6) -> np.ndarray:
    """Return the derivative of a function of x, its columns last."""
    columns = []
    for i in range(len(x)):
        dx = np.zeros(len(x))
        dx[i] = step
        columns.append((function(x + dx) - function(x - dx)) / (2 * step))
    return np.stack(columns, axis=-1)
