"""Pictures: that they are made, and hold what they should."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from scenes import bouncing_ball, chain, cradle, cradle_run

import saltus
from saltus import plots

matplotlib_image = pytest.importorskip("matplotlib.image")


def pixels(path) -> np.ndarray:
    image = matplotlib_image.imread(path)
    assert image.std() > 0.01  # something is drawn
    return image


def test_cradle_is_drawn_as_in_the_paper(tmp_path):
    run = cradle_run()
    figure = run.plot(tmp_path / "cradle.png")
    assert pixels(tmp_path / "cradle.png").shape[0] > 400
    velocities, *sketches = figure.axes
    assert len(sketches) >= 3
    right, left = (line for line in velocities.lines if len(line.get_xdata()) == len(run))
    assert (right.get_linestyle(), left.get_linestyle()) == ("-", ":")
    # Before the first impact the right ball rests, and the left one swings towards it.
    before = run.t < 0.5
    assert np.abs(right.get_ydata()[before]).max() < 1e-9
    assert left.get_ydata()[before].min() >= 0
    np.testing.assert_allclose(
        left.get_ydata(), -run.column("swing_0", "v") * np.cos(run.column("swing_0")), atol=1e-12
    )


def test_times_of_sketches_can_be_chosen(tmp_path):
    figure = plots.plot_cradle(cradle_run(), tmp_path / "two.svg", times=[0.0, 1.5])
    assert len(figure.axes) == 3
    assert (tmp_path / "two.svg").read_text().startswith("<?xml")
    with pytest.raises(saltus.ModelError, match="the run goes from 0 to 2 s"):
        cradle_run().plot(tmp_path / "no.png", times=[3.0])


@pytest.mark.parametrize("balls", [2, 5])
def test_other_cradles(tmp_path, balls):
    run = saltus.simulate(cradle(balls), q={"swing_0": 0.3}, duration=1.0)
    run.plot(tmp_path / "cradle.png")
    pixels(tmp_path / "cradle.png")


def test_a_run_of_one_row_and_one_without_impacts(tmp_path):
    run = saltus.simulate(cradle(), duration=0.02)
    run.plot(tmp_path / "rest.png")
    pixels(tmp_path / "rest.png")


def test_other_models_get_coordinates_and_energies(tmp_path):
    ball = saltus.simulate(bouncing_ball().build(), duration=2.0)
    assert not plots.is_cradle(ball)
    figure = ball.plot(tmp_path / "ball.png")
    pixels(tmp_path / "ball.png")
    assert [axes.get_ylabel() for axes in figure.axes] == [
        "lengths [m]", "energy [J]", "energy error [J]"
    ]  # fmt: skip
    swing = saltus.simulate(chain(12), q=[0.1] * 12, duration=0.5)
    assert swing.plot(tmp_path / "chain.png").axes[0].get_legend() is None
    with pytest.raises(saltus.ModelError, match="no cradle"):
        plots.plot_cradle(ball)


def test_many_impacts_are_a_rug(tmp_path, monkeypatch):
    monkeypatch.setattr("saltus.plots.run.MOST_MARKS", 2)
    run = cradle_run()
    plots.plot_run(run, tmp_path / "rug.png")
    pixels(tmp_path / "rug.png")


def test_a_wrong_ending_is_told(tmp_path):
    with pytest.raises(saltus.ModelError, match="nonsense"):
        cradle_run().plot(tmp_path / "picture.nonsense")


def test_without_matplotlib_everything_else_works():
    code = """
import sys
sys.modules["matplotlib"] = None
sys.modules["matplotlib.figure"] = None
import saltus
run = saltus.simulate(saltus.load_urdf(saltus.scenes.cradle(2)), duration=0.1)
try:
    run.plot("never.png")
except saltus.ModelError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install 'saltus[demo]'" in done.stdout


def test_import_is_light():
    code = "import sys, saltus; print([m for m in ('matplotlib', 'h5py') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
