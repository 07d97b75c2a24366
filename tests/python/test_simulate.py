"""simulate and Trajectory."""

from __future__ import annotations

import math
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
from scenes import bouncing_ball, chain, cradle, cradle_run

import saltus


def test_the_cradle_of_the_manual():
    run = cradle_run()
    assert run.t.shape == (201,)
    assert run.q.shape == run.v.shape == run.p.shape == (201, 6)
    assert run.kinetic.shape == run.potential.shape == run.total.shape == run.shadow.shape
    np.testing.assert_allclose(run.total, run.kinetic + run.potential, rtol=1e-15)
    assert run.impacts["t"][0] == pytest.approx(0.504604, abs=1e-4)
    assert np.all(run.impacts["law"] == saltus.ImpactLaw.nodal_energy)
    assert run.complete
    assert run.energy_error < 1e-4
    assert len(run) == 201
    assert "201 rows" in repr(run)
    assert run.model.pair_names == list(run.pair_names)


def test_first_impact_converges_to_the_exact_time():
    exact = 0.504604
    run = saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=0.6, h=0.001, progress=False)
    assert run.impacts["t"][0] == pytest.approx(exact, abs=2e-6)


def test_impulses_belong_to_their_impacts():
    run = cradle_run()
    assert run.impacts["count"].sum() == len(run.impulses)
    for i, impact in enumerate(run.impacts):
        own = run.impulses[run.impulses["impact"] == i]
        assert len(own) == impact["count"]
        np.testing.assert_array_equal(
            own, run.impulses[impact["first"] : impact["first"] + impact["count"]]
        )
    first = run.impact(0)
    assert first.pairs == ["ball_0 ~ ball_1", "ball_1 ~ ball_2"]
    assert first.t == run.impacts["t"][0]
    with pytest.raises(IndexError):
        run.impact(10**6)


def test_columns_by_name():
    run = cradle_run()
    np.testing.assert_array_equal(run.column("swing_2"), run.q[:, 4])
    np.testing.assert_array_equal(run.column("swing_2", of="v"), run.v[:, 4])
    with pytest.raises(saltus.ModelError, match='no coordinate "swing"; there are swing_0'):
        run.column("swing")
    with pytest.raises(saltus.ModelError, match='no array "x"'):
        run.column("swing_0", of="x")


def test_poses_on_demand():
    run = cradle_run()
    poses = run.poses("ball_0")
    assert poses.shape == (201, 4, 4)
    np.testing.assert_array_equal(poses[17], run.model.pose(run.q[17], "ball_0").matrix())
    assert run.velocities("ball_0").shape == (201, 6)


def test_arrays_cannot_be_written():
    run = cradle_run()
    for name in ("t", "q", "v", "p", "kinetic", "impacts", "impulses"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(run, name)[0] = 0


def test_going_on_where_a_run_ended():
    whole = saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=1.0, progress=False)
    half = saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=0.5, progress=False)
    rest = saltus.simulate(cradle(), state=half.state(-1), duration=0.5, progress=False)
    assert rest.t[0] == pytest.approx(0.5)
    np.testing.assert_allclose(rest.q[-1], whole.q[-1], atol=1e-9)


def test_recording_fewer_rows():
    every = saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=1.0, progress=False)
    tenth = saltus.simulate(
        cradle(), q={"swing_0": 0.3}, duration=1.0, record_every=10, progress=False
    )
    np.testing.assert_array_equal(tenth.q, every.q[::10])
    np.testing.assert_array_equal(tenth.impacts, every.impacts)


def test_bouncing_ball_meets_the_floor():
    run = saltus.simulate(bouncing_ball().build(), duration=2.0, h=0.01, progress=False)
    fall = math.sqrt(2 / 9.81)
    assert run.impacts["t"] == pytest.approx([fall, 3 * fall], abs=1e-3)
    assert run.impact(0).pairs == ["ball ~ floor"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"duration": -1.0}, "duration"),
        ({"duration": math.nan}, "duration"),
        ({"duration": 0.0123}, "duration"),
        ({"duration": 1.0, "h": 0.0}, "h"),
        ({"duration": 1.0, "record_every": 0}, "record_every"),
        ({"duration": 1.0, "q": {"swing_0": -0.05}}, "ball_0 ~ ball_1"),
        ({"duration": 1.0, "q": {"elbow": 1}}, "there are swing_0"),
        ({"duration": 1.0, "v": [1.0]}, "v has 1 entry"),
        ({"duration": 1.0, "q": [0.0] * 6, "state": cradle().state()}, "not both"),
    ],
)
def test_what_cannot_be_run(options, message):
    with pytest.raises(saltus.ModelError, match=message):
        saltus.simulate(cradle(), **options)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "duration"),
        (
            {"duration": 1.0, "max_iteration": 1},
            '"max_iteration"; bounds of a step are order, certify, max_iter',
        ),
        (
            {"duration": 1.0, "law": 0},
            r"^law = 0 is no ImpactLaw; there are saltus.ImpactLaw.nodal_energy, ",
        ),
        ({"duration": 1.0, "model": "m.urdf"}, "model is a str; saltus.load_urdf makes"),
    ],
)
def test_wrong_arguments_are_type_errors(options, message):
    with pytest.raises(TypeError, match=message):
        saltus.simulate(**{"model": cradle(), **options})


def test_arguments_after_the_third_are_keywords():
    with pytest.raises(TypeError):
        saltus.simulate(cradle(), None, None, 1.0)  # keyword-only


def test_no_collisions():
    run = saltus.simulate(
        cradle(), q={"swing_0": 0.3}, duration=1.0, collisions=False, progress=False
    )
    assert len(run.impacts) == 0
    assert run.impulses.shape == (0,)


def test_progress_is_told_and_its_errors_come_out():
    parts: list[float] = []
    saltus.simulate(chain(16), q=[0.1] * 16, duration=20.0, h=0.002, progress=parts.append)
    assert parts == sorted(parts)
    assert all(0 <= part <= 1 for part in parts)

    def fail(part: float) -> None:
        raise LookupError("in progress")

    with pytest.raises(LookupError, match="in progress"):
        saltus.simulate(chain(16), q=[0.1] * 16, duration=200.0, h=0.002, progress=fail)


def test_no_bar_on_short_runs_and_where_nobody_looks(capfd):
    saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=0.1)
    assert capfd.readouterr().err == ""
    saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=0.1, progress=True)
    assert "0.10 s" in capfd.readouterr().err


INTERRUPTED = """
    import sys, saltus
    model = saltus.load_urdf(saltus.scenes.chain(16))
    def tell(part):
        print("running", flush=True)
    run = saltus.simulate(model, q=[0.1] * 16, duration=1e5, h=0.001, record_every=1000,
                          progress=tell)
    print(run.complete, len(run), run.t[-1] > 0, run.q.shape == run.p.shape, flush=True)
"""


def test_ctrl_c_keeps_what_is_done():
    command = [sys.executable, "-c", textwrap.dedent(INTERRUPTED)]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, **pipes) as process:
        try:
            assert process.stdout.readline() == "running\n"
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode == 0, err
    complete, rows, *others = out.splitlines()[-1].split()
    assert complete == "False"
    assert int(rows) >= 1
    assert others == ["True", "True"]
    assert "saltus: stopped after" in err
