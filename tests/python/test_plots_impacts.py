"""Pictures of impacts: rows, marks and their sizes."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import bouncing_ball, cradle, cradle_run
from test_plots import pixels

import saltus
from saltus.plots import impacts

pytest.importorskip("matplotlib")


def rows_of(axes) -> list[str]:
    return [label.get_text() for label in axes.get_yticklabels()]


def marks(axes) -> tuple[np.ndarray, np.ndarray]:
    """Return places and areas of the marks."""
    (scatter,) = (c for c in axes.collections if hasattr(c, "get_sizes") and len(c.get_sizes()))
    return np.asarray(scatter.get_offsets()), scatter.get_sizes()


def test_a_run_is_a_raster(tmp_path):
    run = cradle_run()
    (axes,) = run.plot_impacts(tmp_path / "run.png").axes
    pixels(tmp_path / "run.png")
    assert rows_of(axes) == ["ball_0 ~ ball_1", "ball_1 ~ ball_2"]
    places, areas = marks(axes)
    assert len(places) == len(run.impulses)  # each pair takes one impulse an impact
    np.testing.assert_array_equal(places[:, 0], np.repeat(run.impacts["t"], 2))
    np.testing.assert_allclose(areas / areas.max(), 1, rtol=1e-3)
    assert axes.get_xlabel() == "time [s]"
    assert axes.get_title(loc="left") == "2 impacts, 4 impulses"


def test_a_cascade_has_its_impulses_in_order(tmp_path):
    run = saltus.simulate(cradle(5), q={"swing_0": 0.3, "swing_1": 0.3}, duration=1.0)
    (axes,) = run.plot_impacts(tmp_path / "cascade.svg", index=0).axes
    impact = run.impact(0)
    names = rows_of(axes)
    assert names == [f"ball_{i} ~ ball_{i + 1}" for i in range(4)]
    places, areas = marks(axes)
    assert places[:, 0].tolist() == [1, 2, 3, 4, 5, 6]
    assert [names[int(row)] for row in places[:, 1]] == impact.pairs
    np.testing.assert_allclose(areas / areas[0], impact.lambdas / impact.lambdas[0], rtol=1e-9)
    texts = [text.get_text() for text in axes.texts]
    assert [text for text in texts if text in set("123456")] == list("123456")
    for total in (impact.lambdas[1], 2 * impact.lambdas[1]):
        assert texts.count(f"{total:.4g}") == 2
    assert "6 impulses on 4 contacts" in axes.get_title(loc="left")


def test_areas_are_as_impulses(tmp_path):
    impact = saltus.Impact(
        0.0, ["a ~ b", "b ~ c", "a ~ b"], [4.0, 1.0, 1e-9],
        contacts=2, law=saltus.ImpactLaw.nodal_energy, fallback=False,
    )  # fmt: skip
    (axes,) = impacts.plot_cascade(impact, tmp_path / "areas.png").axes
    _, areas = marks(axes)
    assert areas[0] == pytest.approx(4 * areas[1])
    assert areas[2] == impacts.SMALLEST**2  # what is weak is still seen


def test_one_impact_is_drawn_as_a_cascade(tmp_path):
    table = saltus.load_urdf(saltus.scenes.billiard(), gravity=(0, 0, 0))
    run = saltus.simulate(table, v={"x_0": 5.0}, duration=0.2)
    (axes,) = run.plot_impacts(tmp_path / "break.png").axes
    assert axes.get_xlabel() == "impulses in order"
    assert len(marks(axes)[0]) == len(run.impulses)


def test_a_run_without_impacts_and_one_of_a_single_pair(tmp_path):
    rest = saltus.simulate(cradle(), duration=0.01)
    rest.plot_impacts(tmp_path / "rest.png")
    assert (tmp_path / "rest.png").stat().st_size > 1000
    ball = saltus.simulate(bouncing_ball().build(), duration=3.0)
    (axes,) = ball.plot_impacts(tmp_path / "ball.png").axes
    assert rows_of(axes) == ["ball ~ floor"]
    assert len(marks(axes)[0]) == len(ball.impacts)


def test_many_rows_are_named_in_part(tmp_path):
    run = saltus.simulate(cradle(100), q={"swing_0": 0.3}, duration=0.6)
    (axes,) = run.plot_impacts(tmp_path / "long.png").axes
    names = rows_of(axes)
    assert names[0] == "ball_0 ~ ball_1"
    assert 10 < len(names) <= impacts.MOST_LABELS
    assert len(marks(axes)[0]) == 99


def test_rows_must_hold_all_pairs(tmp_path):
    with pytest.raises(saltus.ModelError, match='no row for pair "ball_1 ~ ball_2"; rows are a'):
        impacts.plot_cascade(cradle_run().impact(0), tmp_path / "no.png",
                                   pairs=["a", "ball_0 ~ ball_1"])  # fmt: skip
