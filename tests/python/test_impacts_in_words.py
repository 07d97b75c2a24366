"""Impacts as people read them: lines, and tables of cascades."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import bouncing_ball, cradle, cradle_run

import saltus
from saltus.records import impacts


def made(pairs: list[str], lambdas: list[float], **rest: object) -> saltus.Impact:
    """Return an impact on as many contacts as it has pairs."""
    known = {"contacts": len(set(pairs)), "law": saltus.ImpactLaw.nodal_energy, "fallback": False}
    return saltus.Impact(0.25, pairs, lambdas, **(known | rest))


class Certified(saltus.Impact):
    """What an impact looks like that knows how certain its outcome is."""

    certificate: str | None = "unique, A2, at most 3 impulses"


def test_a_printed_impact_is_its_cascade():
    run = saltus.simulate(cradle(5), q={"swing_0": 0.3, "swing_1": 0.3}, duration=1.0)
    impact = run.impact(0)
    lines = str(impact).splitlines()
    assert lines[0] == (f"impact at t = {impact.t:.6f} s: 6 impulses on 4 contacts; nodal_energy")
    assert lines[1].split() == ["#", "pair", "λ", "[N", "s]"]
    rows = [line.split(maxsplit=1) for line in lines[2:]]
    assert [row[0] for row in rows] == list("123456")
    assert [row[1].rsplit(maxsplit=1)[0] for row in rows] == impact.pairs
    values = [float(row[1].rsplit(maxsplit=1)[1]) for row in rows]
    np.testing.assert_allclose(values, impact.lambdas, rtol=1e-3)
    assert len({line.index("ball_") for line in lines[2:]}) == 1  # columns stand below each other
    assert saltus.impact_table(impact) == str(impact)
    assert repr(impact).startswith("Impact(t=")


def test_impacts_of_a_stepper_print_alike():
    stepper = saltus.Stepper(cradle(), h=0.01)
    state = cradle().state({"swing_0": 0.3})
    while not stepper.report.impacts:
        state = stepper.advance(state)
    assert str(stepper.report.impacts[0]) == str(cradle_run().impact(0))


def test_friction_has_a_column_where_there_is_any():
    pairs, lambdas = ["a ~ floor", "bb ~ floor"], [1.0, 0.25]
    without = made(pairs, lambdas)
    np.testing.assert_array_equal(without.tangentials, np.zeros((2, 3)))
    assert str(without).splitlines()[1:] == [
        "  #  pair        λ [N s]",
        "  1  a ~ floor   1",
        "  2  bb ~ floor  0.25",
    ]
    rubbed = made(pairs, lambdas, tangentials=[[0.125, -0.0, 0], [0, 0, 0]])
    assert str(rubbed).splitlines() == [
        impacts.headline(without),
        "  #  pair        λ [N s]  friction [N s]",
        "  1  a ~ floor   1        (0.125, 0, 0)",
        "  2  bb ~ floor  0.25     (0, 0, 0)",
    ]


def test_friction_is_three_numbers_an_impulse():
    for wrong in ([[1.0, 0, 0]], [[1.0, 0], [0, 0]]):
        with pytest.raises(saltus.ModelError, match="there are 2 impulses, three numbers each"):
            made(["a ~ b", "b ~ c"], [1.0, 1.0], tangentials=wrong)


def test_one_is_singular():
    ball = saltus.simulate(bouncing_ball().build(), duration=0.5)
    assert "1 impulse on 1 contact;" in impacts.headline(ball.impact(0))


def test_long_cascades_are_cut_in_the_middle():
    pairs = [f"ball_{i} ~ ball_{i + 1}" for i in range(99)]
    impact = made(pairs, [1.0] * 99)
    assert len(impacts.impact_table(impact).splitlines()) == 2 + 99
    printed = str(impact).splitlines()
    assert len(printed) == 2 + impacts.MOST_ROWS + 1
    assert f"... {99 - impacts.MOST_ROWS} more" in printed[2 + impacts.MOST_ROWS // 2]
    assert printed[-1].split()[0] == "99"
    three = impacts.impact_table(impact, most=3).splitlines()[2:]
    assert [line.split()[0] for line in three] == ["1", "2", "...", "99"]
    assert impacts.impact_table(impact, most=0).splitlines()[2:] == ["     ... 99 more"]


def test_an_impact_without_impulses_is_only_its_heads():
    assert len(str(made([], [])).splitlines()) == 2


def test_a_fallback_is_said():
    impact = made(["a ~ b"], [1.0], fallback=True)
    assert impacts.headline(impact).endswith("; nodal_energy as fallback")


@pytest.mark.parametrize("nothing", [None, ""])
def test_what_is_certain_comes_last(nothing, monkeypatch):
    impact = Certified(
        0.25,
        ["a ~ b", "b ~ c"],
        [1.0, 1.0],
        contacts=2,
        law=saltus.ImpactLaw.nodal_energy,
        fallback=False,
    )
    counts = "2 impulses on 2 contacts"
    assert impacts.count_line(impact) == f"{counts}; unique, A2, at most 3 impulses"
    assert "unique, A2, at most 3 impulses" in str(impact).splitlines()[0]
    monkeypatch.setattr(Certified, "certificate", nothing)
    assert impacts.count_line(impact) == counts
