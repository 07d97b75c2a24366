"""Makes identify.webp, beside this file: the misfit of tosses, and how its gradient is followed.

.venv/bin/python python/docs/pictures/identify.py

Needs matplotlib and Pillow.
"""

from __future__ import annotations

import io
import runpy
from contextlib import redirect_stdout
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from scipy.optimize import minimize

HERE = Path(__file__).parent
EXAMPLE = HERE.parents[2] / "examples" / "identify_cube.py"
ORANGE = "#d55e00"  # beside the blues of the map the colour-blind can tell it


def main() -> None:
    with redirect_stdout(io.StringIO()):
        misfit = runpy.run_path(str(EXAMPLE))["misfit"]
    path = [np.array([0.3, 0.3])]
    minimize(misfit, path[0], jac=True, bounds=[(0.01, 1)] * 2, callback=path.append)
    friction, restitution = np.linspace(0.05, 0.35, 41), np.linspace(0.01, 0.35, 41)
    costs = np.array([[misfit((mu, e))[0] for mu in friction] for e in restitution])
    figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
    levels = np.arange(-4, 1.25, 0.25)
    drawn = ax.contourf(
        friction, restitution, np.log10(np.maximum(costs, 1e-4)), levels, cmap="Blues_r"
    )
    figure.colorbar(drawn, label="log₁₀ of the misfit")
    ax.plot(*np.transpose(path), "o-", color=ORANGE, ms=4, label="gradient")
    ax.plot(0.18, 0.125, "k+", ms=12, label="true")
    ax.set(title="Eight tosses of a cube", xlabel="friction", ylabel="restitution")
    ax.legend(frameon=False)
    page = io.BytesIO()
    figure.savefig(page, dpi=90)
    Image.open(page).convert("RGB").save(HERE / "identify.webp", quality=80, method=6)


if __name__ == "__main__":
    main()
