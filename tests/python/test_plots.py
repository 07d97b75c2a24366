"""Pictures: that they are made, and hold what they should."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from scenes import bouncing_ball, chain, cradle, cradle_run

import saltus
from saltus import plots
from saltus.plots.lines import style_of

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


def labels(figure) -> list[str]:
    return [axes.get_ylabel() for axes in figure.axes]


def legend(axes) -> list[str]:
    return [text.get_text() for text in axes.get_legend().get_texts()]


def line(axes, name: str):
    (found,) = (each for each in axes.lines if each.get_label() == name)
    return found


def drawn(figure, label: str):
    """Return the axes with a label."""
    (found,) = (axes for axes in figure.axes if axes.get_ylabel() == label)
    return found


def test_a_ball_has_all_its_panels(tmp_path):
    run = saltus.simulate(bouncing_ball().build(), duration=2.0)
    assert not plots.is_cradle(run)
    figure = run.plot(tmp_path / "ball.png")
    pixels(tmp_path / "ball.png")
    assert labels(figure) == [
        "position [m]", "velocity [m/s]", "gap [m]", "energy [J]", "H − H₀ [J]"
    ]  # fmt: skip
    assert figure.axes[-1].get_xlabel() == "time [s]"
    assert figure.axes[0].get_title(loc="left") == "ball: 2 impacts (grey)"
    times = run.impacts["t"]
    for axes in figure.axes:
        marks = [mark.get_xdata()[0] for mark in axes.lines if mark.get_color() == "0.8"]
        np.testing.assert_array_equal(marks, times)
    np.testing.assert_array_equal(line(figure.axes[0], "z").get_ydata(), run.q[:, 0])
    np.testing.assert_array_equal(line(figure.axes[1], "z").get_ydata(), run.v[:, 0])
    with pytest.raises(saltus.ModelError, match="no cradle"):
        plots.plot_cradle(run)


def test_gaps_are_zero_at_impacts(tmp_path):
    run = saltus.simulate(bouncing_ball().build(), duration=2.0)
    axes = drawn(run.plot(tmp_path / "ball.png"), "gap [m]")
    gap = line(axes, "ball ~ floor")
    t, phi = gap.get_xdata(), gap.get_ydata()
    assert len(t) == len(run) + len(run.impacts)
    np.testing.assert_array_equal(phi[np.isin(t, run.impacts["t"])], 0)
    lowest = run.model.gaps(run.q[10]).phi.min()
    assert phi[t == run.t[10]] == pytest.approx(lowest, abs=1e-12)
    np.testing.assert_array_equal(line(axes, "_impacts").get_xdata(), run.impacts["t"])


def test_energies_and_their_balance(tmp_path):
    run = saltus.simulate(bouncing_ball().build(), duration=2.0)
    figure = run.plot(tmp_path / "ball.png")
    energies = drawn(figure, "energy [J]")
    assert legend(energies) == ["kinetic", "potential − min", "total − min"]
    potential = line(energies, "potential − min").get_ydata()
    assert potential.min() == 0
    np.testing.assert_allclose(potential + run.potential.min(), run.potential, atol=1e-12)
    balance = drawn(figure, "H − H₀ [J]")
    np.testing.assert_array_equal(line(balance, "total").get_ydata(), run.total - run.total[0])
    assert legend(balance) == ["total", "shadow"]


def driven() -> saltus.Trajectory:
    builder = saltus.read_urdf(saltus.urdf_dir() / "arm.urdf")
    builder.add_position_servo("lift", joint="shoulder", kp=300, kd=30)
    model = builder.add_motor("turn", joint="waist").set_limit("waist", -0.4, 0.4).build()
    return saltus.simulate(model, duration=0.5, control={"lift": 0.5, "turn": 20.0})


def test_driven_robots_show_controls_limits_and_work(tmp_path):
    run = driven()
    figure = run.plot(tmp_path / "arm.png")
    pixels(tmp_path / "arm.png")
    assert labels(figure) == [
        "angle [rad]", "position [m]", "velocity [rad/s]", "velocity [m/s]", "gap [m]",
        "control", "energy [J]", "work [J]", "H − H₀ − W [J]",
    ]  # fmt: skip
    control = drawn(figure, "control")
    assert legend(control) == ["lift", "turn"]
    np.testing.assert_array_equal(line(control, "turn").get_ydata(), 20.0)
    assert line(control, "turn").get_drawstyle() == "steps-post"
    assert "limit 0.4" in legend(drawn(figure, "angle [rad]"))
    assert "limit −0.4" not in legend(drawn(figure, "angle [rad]"))
    work = drawn(figure, "work [J]")
    assert {"lift", "turn", "damping"} <= set(legend(work))
    np.testing.assert_array_equal(line(work, "lift").get_ydata(), run.work["lift"])
    left = line(drawn(figure, "H − H₀ − W [J]"), "total").get_ydata()
    np.testing.assert_allclose(left, run.total - run.total[0] - sum(run.work.values()), atol=1e-12)


def test_free_bodies_are_drawn_by_their_units(tmp_path):
    scene = saltus.ModelBuilder("free").set_gravity((0, 0, 0))
    scene.add_body("a", saltus.Sphere(0.1), mass=1.0)
    run = saltus.simulate(scene.build(), v={"a_vx": 1.0, "a_wz": 2.0}, duration=0.5)
    figure = run.plot(tmp_path / "free.png", panels=["q", "v"])
    assert labels(figure) == ["position [m]", "quaternion", "velocity [rad/s]", "velocity [m/s]"]
    assert legend(drawn(figure, "velocity [rad/s]")) == ["a_wx", "a_wy", "a_wz"]
    assert legend(drawn(figure, "quaternion")) == ["a_qx", "a_qy", "a_qz", "a_qw"]
    one = run.plot(tmp_path / "one.png", panels=["v", "q"], names=["a_x", "a_wz"])
    assert labels(one) == ["velocity [rad/s]", "position [m]"]
    for wrong, words in (
        ({"panels": ["w"]}, 'no panel "w"; there are q, v, gaps'),
        ({"names": ["b_x"]}, 'no coordinate "b_x"'),
        ({"pairs": ["a ~ b"]}, 'no pair "a ~ b"'),
        ({"panels": ["gaps"]}, "nothing to draw"),
    ):
        with pytest.raises(saltus.ModelError, match=words):
            run.plot(tmp_path / "no.png", **wrong)


def test_lines_can_be_told_apart_without_colours(tmp_path):
    swing = saltus.simulate(chain(8), q=[0.1] * 8, duration=0.5)
    axes = swing.plot(tmp_path / "chain.png").axes[0]
    assert [each.get_color() for each in axes.lines] == [style_of(i)["color"] for i in range(8)]
    assert len({(style_of(i)["color"], str(style_of(i)["ls"])) for i in range(8)}) == 8
    assert len({str(style_of(i)["ls"]) for i in range(8)}) == 4
    assert legend(axes) == list(swing.coordinate_names)


def test_many_lines_go_from_dark_to_light(tmp_path):
    swing = saltus.simulate(chain(40), q=[0.1] * 40, duration=0.1)
    axes = swing.plot(tmp_path / "chain.png").axes[0]
    assert len(axes.lines) == 40
    assert legend(axes) == ["joint_0", "joint_39"]
    assert axes.get_legend().get_title().get_text() == "40 lines, from"
    light = [np.dot(each.get_color()[:3], (0.21, 0.72, 0.07)) for each in axes.lines]
    assert (np.diff(light) > 0).all()


def test_long_names_are_shortened(tmp_path):
    name = "a_body_whose_name_nobody_would_wish_to_type"
    scene = saltus.ModelBuilder("long").add_floor(restitution=1, friction=0)
    scene.add_body(name, saltus.Sphere(0.1), mass=1.0, X=saltus.Pose((0, 0, 0.2)))
    run = saltus.simulate(scene.build(), duration=0.5)
    for axes in run.plot(tmp_path / "long.png").axes:
        assert all(len(text) <= 22 for text in legend(axes))
        assert len(set(legend(axes))) == len(legend(axes))
    (rows,) = run.plot_impacts(tmp_path / "impacts.png").axes
    assert [text.get_text() for text in rows.get_yticklabels()] == [
        "a_body_whose…_wish_to_type ~ floor"
    ]


def test_runs_of_one_row_have_dots(tmp_path):
    run = saltus.Trajectory.from_states(bouncing_ball().build(), [0.0], [[1.0]])
    figure = run.plot(tmp_path / "row.png")
    pixels(tmp_path / "row.png")
    assert line(figure.axes[0], "z").get_marker() == "o"
    run.plot_impacts(tmp_path / "impacts.png")


def test_a_cradle_has_panels_where_they_are_asked_for(tmp_path):
    rest = saltus.simulate(cradle(), duration=0.02)
    rest.plot(tmp_path / "rest.png")
    pixels(tmp_path / "rest.png")
    figure = cradle_run().plot(tmp_path / "panels.png", panels=["gaps"])
    assert legend(figure.axes[0]) == ["ball_0 ~ ball_1", "ball_1 ~ ball_2"]


def test_a_run_that_stopped_says_so(tmp_path):
    def stop(now):
        if now.t > 0.195:
            raise RuntimeError

    model = driven().model
    with pytest.raises(RuntimeError) as caught:
        saltus.simulate(model, duration=0.5, control=stop)
    figure = caught.value.trajectory.plot(tmp_path / "stopped.png")
    assert figure.axes[0].get_title(loc="left") == "arm: 0 impacts, stopped at 0.2 s"


def test_a_run_without_its_model_is_drawn(tmp_path):
    path = tmp_path / "ball.h5"
    saltus.simulate(bouncing_ball().build(), duration=0.5).save(path)
    run = saltus.load(path)
    figure = run.plot(tmp_path / "ball.png")
    assert labels(figure) == ["coordinates", "velocities", "energy [J]", "H − H₀ [J]"]


def test_many_impacts_are_a_rug(tmp_path, monkeypatch):
    monkeypatch.setattr("saltus.plots.lines.MOST_MARKS", 2)
    run = saltus.simulate(bouncing_ball().build(), duration=3.0)
    assert len(run.impacts) > 2
    for axes in run.plot(tmp_path / "rug.png").axes:
        (rug,) = (each for each in axes.lines if each.get_marker() == "|")
        np.testing.assert_array_equal(rug.get_xdata(), run.impacts["t"])
    pixels(tmp_path / "rug.png")


def test_rounding_is_drawn_flat(tmp_path):
    rest = saltus.simulate(chain(2), duration=0.1)
    for axes in rest.plot(tmp_path / "rest.png").axes:
        low, high = axes.get_ylim()
        assert high - low >= 2e-12


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
