"""Steps that cannot be made as a whole: made of shorter arcs, and told."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import thrown

import saltus
from saltus.records.tables import counted

# A can on its rim, nearly flat and spinning: no arc of 5 ms is the motion's.
Q = [0, 0, 0.105539, -0.956946, 0.289455, -0.018799, 0.010798]
V = [0, 0, -1.635133, 5.282512, 20.060432, -0.55442]
H = 0.005


def can() -> saltus.Model:
    return thrown(saltus.Cylinder(0.1, 0.1), restitution=0, friction=0)


def start(model: saltus.Model) -> dict[str, object]:
    return {"q": model.normalized(Q), "v": V}


def test_never_is_an_error_that_keeps_what_was_before():
    model = can()
    with pytest.raises(
        saltus.StepError, match=r"DEL residual .* held by body\[rim\+\] ~ floor; a smaller h"
    ) as error:
        saltus.simulate(model, **start(model), duration=0.5, h=H, max_halvings=0, strict=True)
    rows = error.value.trajectory
    assert rows.total.max() <= rows.total[0] + 0.02 * rows.kinetic.max()
    assert len(rows.fallbacks) == 0


def test_a_step_by_halves_keeps_the_energy_and_says_so():
    model = can()
    run = saltus.simulate(model, **start(model), duration=0.5, h=H)
    assert run.complete
    # a plastic landing loses energy; nothing gains it but by O(h^2): 2 % of what moves
    assert run.total.max() <= run.total[0] + 0.02 * run.kinetic.max()
    assert 0 < len(run.fallbacks) < len(run)
    assert set(run.fallbacks["rung"]) == {"halved"}
    parts = H / run.fallbacks["tau"]
    np.testing.assert_array_equal(parts, 2 ** np.log2(parts).round())
    assert parts.min() >= 2
    assert parts.max() <= 64
    assert np.isin(run.fallbacks["t"].round(9), run.t.round(9)).all()
    assert f", {counted(len(run.fallbacks), 'step')} by shorter arcs" in run.summary()


def test_the_report_tells_and_forgets():
    model = can()
    stepper = saltus.Stepper(model, h=H)
    state, told = model.state(**start(model)), []
    for _ in range(10):
        before = state.t
        state = stepper.advance(state)
        for t, tau, rung, energy, pair in stepper.report.fallbacks:
            assert (t, rung, energy, pair) == (before, "halved", 0, "")
            assert tau < H
            assert stepper.report.arcs >= H / tau
        told.append(len(stepper.report.fallbacks))
    assert set(told) == {0, 1}


def test_the_same_bits_again():
    """What an attempt that failed left behind is nothing to the next."""
    model = can()
    runs = [saltus.simulate(model, **start(model), duration=0.1, h=H) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)


def test_files_keep_them(tmp_path):
    model = can()
    run = saltus.simulate(model, **start(model), duration=0.05, h=H)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5", model=model)
    np.testing.assert_array_equal(again.fallbacks, run.fallbacks)
    assert again.options.max_halvings == 6


def test_jams_are_no_matter_of_duration():
    """Bodies between which nothing opens jam however short the arc: no attempts are wasted."""
    model = saltus.load_urdf(saltus.scenes.cradle(3))
    with pytest.raises(saltus.JammedError):
        saltus.simulate(model, q={"swing_0": 0.3}, duration=2.0, max_impulses=1)


@pytest.mark.parametrize("halvings", [-1, 21])
def test_the_option_has_a_range(halvings):
    with pytest.raises(saltus.ModelError, match=r"max_halvings = .*; it must be in \[0, 20\]"):
        saltus.Stepper(can(), max_halvings=halvings)
