"""Steps that cannot be made as a whole: made of shorter arcs, and told."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import thrown

import saltus
from saltus.records.tables import counted

# A coin that lands on its rim, nearly flat and wobbling: no arc of 5 ms is the motion's.
Q = [0, 0, 0.026731858, 0.990950105, 0.129877194, 0.010642693, 0.032195286]
V = [0.400402104, 0.914242107, -2.171697491, 13.380449693, 23.047231984, 1.106019701]
H = 0.005


def coin() -> saltus.Model:
    return thrown(saltus.Cylinder(0.1, 0.02), restitution=0, friction=0)


def start(model: saltus.Model) -> dict[str, object]:
    return {"q": model.normalized(Q), "v": V}


def test_never_is_an_error_that_keeps_what_was_before():
    model = coin()
    with pytest.raises(
        saltus.StepError,
        match=r"body\[rim\+\] ~ floor overlap by .* m where the arc .*; a smaller h",
    ) as error:
        saltus.simulate(model, **start(model), duration=0.5, h=H, max_halvings=0, strict=True)
    rows = error.value.trajectory
    assert rows.total.max() <= rows.total[0] + 0.02 * rows.kinetic.max()
    assert len(rows.fallbacks) == 0


def test_a_step_by_halves_keeps_the_energy_and_says_so():
    model = coin()
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
    model = coin()
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
    model = coin()
    runs = [saltus.simulate(model, **start(model), duration=0.1, h=H) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)


def test_files_keep_them(tmp_path):
    model = coin()
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
        saltus.Stepper(coin(), max_halvings=halvings)


# A chain of four links that tumbles free of contacts, h times its fastest rate about 0.75.
CHAIN = [  # joint type, placement [m] of the joint along x, axis
    ("spherical", -0.003684177753681628, (1, 0, 0)),
    ("revolute", 0.014279176663003011, (0.28569799, 0.95778092, 0.03213053)),
    ("revolute", 0.04549820369058477, (0.37407119, -0.15648715, -0.9141021)),
]
# fmt: off
CHAIN_Q = [
    1.67813136, -0.96921489, 0.7195592, -0.41870306327799944, -0.2868587390253934,
    0.8542623446907968, 0.11240842979849598, 0.3717816948014443, -0.6024683920886094,
    -0.001828758494534316, -0.7062626024271002, -0.4339229641116069, -3.113882870889551,
]
CHAIN_P = [
    5.747702618703155, -5.343466253242461, -5.428339077586268, 3.2864141416622714,
    -6.259013612407865, 1.9812014624608993, -2.8450872020495765, 3.3984339893829816,
    0.8791447394510974, 1.247734265753261, 0.029071353574616043,
]
# fmt: on


def test_a_free_arc_that_is_another_motion_is_made_of_shorter_ones():
    """Its equation has a root with half as much energy again: 60 J became 94 J without a word."""
    builder = saltus.ModelBuilder().add_body("l0", saltus.Box((0.03, 0.04, 0.14)), mass=1)
    for i, (kind, x, axis) in enumerate(CHAIN):
        builder.add_link(f"l{i + 1}", saltus.solid_box(1, (0.03, 0.03, 0.15)))
        builder.add_joint(
            f"j{i + 1}", kind, parent=f"l{i}", child=f"l{i + 1}", X_PJ=saltus.Pose((x, 0, 0.4)),
            axis=axis,
        )  # fmt: skip
    model = builder.build()
    start = saltus.State(0, model.normalized(CHAIN_Q), CHAIN_P)
    run = saltus.simulate(model, state=start, duration=0.02, h=0.02)
    assert set(run.fallbacks["rung"]) == {"halved"}
    # the swing of an arc of h w = 0.75: (h w)^2 / 8 of what moves at most
    assert abs(run.total[1] - run.total[0]) < 0.07 * run.kinetic[0]
    with pytest.raises(saltus.StepError, match=r"gains .* solved by another motion"):
        saltus.simulate(model, state=start, duration=0.02, h=0.02, max_halvings=0)
