"""What an exception that ends a run holds: the rows before it."""

from __future__ import annotations

import dataclasses
import sys

import numpy as np
import pytest
from helpers import run_cli
from scenes import bouncing_ball, cradle

import saltus

START = {"q": {"swing_0": 0.3}, "duration": 1.0, "progress": False}
IMPACT = 0.5046  # [s] within the step after row 50


def assert_holds_the_start_of(run: saltus.Trajectory, whole: saltus.Trajectory, rows: int) -> None:
    assert len(run) == rows
    assert not run.complete
    assert whole.complete
    for name in ("t", "q", "v", "p", "kinetic", "potential", "total", "shadow"):
        np.testing.assert_array_equal(getattr(run, name), getattr(whole, name)[:rows])


def test_a_step_error_has_the_rows_before_it():
    whole = saltus.simulate(cradle(), **START)
    with pytest.raises(saltus.JammedError) as error:
        saltus.simulate(cradle(), **START, max_impulses=1, record_contacts=True)
    run = error.value.trajectory
    assert_holds_the_start_of(run, whole, 51)
    assert "the rows up to t = 0.5 s are its attribute `trajectory`" in str(error.value)
    assert error.value.t == pytest.approx(IMPACT, abs=0.01)
    assert len(run.contacts) == len(run.impacts) == 0
    assert "0 to 0.5 s (stopped)" in run.summary()


def test_rows_after_an_impact_are_kept_with_it():
    calls = []

    def law(problem: saltus.ImpactProblem) -> np.ndarray:
        calls.append(problem.t)
        if len(calls) == 2:
            raise LookupError("no second time")
        return saltus.resolve_impact(problem.M, problem.N, problem.v).v @ problem.M

    with pytest.raises(LookupError) as error:
        saltus.simulate(cradle(), **{**START, "duration": 4.0}, law=law)
    assert error.value.args == ("no second time",)  # the message of others stays theirs
    run = error.value.trajectory
    assert len(run) == 1 + int(calls[1] / 0.01)
    assert list(run.impacts["t"]) == calls[:1]
    assert len(run.impulses) == 2
    if sys.version_info >= (3, 11):
        assert "are its attribute `trajectory`" in error.value.__notes__[0]


def test_an_interrupt_within_a_law_has_them_too():
    def law(_: saltus.ImpactProblem) -> np.ndarray:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as error:
        saltus.simulate(cradle(), **START, law=law)
    assert_holds_the_start_of(error.value.trajectory, saltus.simulate(cradle(), **START), 51)


@pytest.mark.parametrize("progress", [True, False, None, lambda _: None])
def test_an_exception_that_takes_no_attributes_comes_out_as_it_is(progress):
    @dataclasses.dataclass(frozen=True)
    class FrozenError(Exception):
        why: str

    def law(_: saltus.ImpactProblem) -> np.ndarray:
        raise FrozenError("cold")

    with pytest.raises(FrozenError, match="cold"):
        saltus.simulate(cradle(), **{**START, "progress": progress}, law=law)


def test_a_law_of_a_wrong_answer():
    with pytest.raises(saltus.StepError, match=r"momenta.*; the rows up to") as error:
        saltus.simulate(cradle(), **START, law=lambda problem: problem.p[:2])
    assert len(error.value.trajectory) == 51


def test_a_start_that_overlaps_is_a_row_that_the_message_does_not_tell_of():
    model = bouncing_ball().build()
    with pytest.raises(saltus.ModelError, match="overlap") as error:
        saltus.simulate(model, q={"z": -1.5}, duration=1.0)
    np.testing.assert_array_equal(error.value.trajectory.q, [[-1.5]])
    assert "trajectory" not in str(error.value)


def test_errors_before_a_run_have_none():
    with pytest.raises(saltus.ModelError) as error:
        saltus.simulate(cradle(), duration=-1.0)
    assert error.value.trajectory is None
    rng = np.random.default_rng(0)
    chain = saltus.load_urdf(saltus.scenes.chain(30))
    with pytest.raises(saltus.StepError) as error:
        saltus.Stepper(chain, h=0.5, max_halvings=0).advance(chain.state(rng.uniform(-2, 2, 30)))
    assert error.value.trajectory is None


def test_the_run_before_an_error_can_be_saved_and_gone_on_with(tmp_path):
    with pytest.raises(saltus.JammedError) as error:
        saltus.simulate(cradle(), **START, max_impulses=1)
    error.value.trajectory.save(tmp_path / "before.h5")
    before = saltus.load(tmp_path / "before.h5")
    assert not before.complete
    rest = saltus.simulate(cradle(), state=before.state(-1), duration=0.5)
    assert rest.complete
    assert len(rest.impacts) == 1


def test_the_run_that_stops_a_batch_has_its_rows():
    starts = {"swing_0": np.array([0.0, 0.3, -0.05])}
    options = {"duration": 1.0, "progress": False, "max_impulses": 1}
    with pytest.raises(saltus.JammedError, match=r"^run 1: .*; the rows up to t = 0.5 s") as error:
        saltus.simulate_batch(cradle(), starts, **options, on_failure=saltus.OnFailure.stop)
    assert_holds_the_start_of(error.value.trajectory, saltus.simulate(cradle(), **START), 51)


def test_the_command_line_writes_them(tmp_path):
    (tmp_path / "chain.urdf").write_text(saltus.scenes.chain(20))
    bent = [part for i in range(20) for part in ("--set", f"joint_{i}=0.05")]
    numbers = ["--duration", "50", "--h", "1", "--out", tmp_path / "run.h5"]
    done = run_cli("simulate", tmp_path / "chain.urdf", *bent, *numbers)
    assert done.returncode == 1
    assert "DEL residual" in done.stderr
    before = saltus.load(tmp_path / "run.h5")
    assert not before.complete
    assert f"trajectory, up to t = {before.t[-1]:g} s: " in done.stdout
