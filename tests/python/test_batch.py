"""simulate_batch and BatchTrajectory."""

from __future__ import annotations

import math
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest
from scenes import chain, cradle

import saltus

ANGLES = np.linspace(0.0, 0.5, 12)
ARRAYS = ("t", "q", "v", "p", "kinetic", "potential", "shadow", "total", "impacts", "energy_error")


def fan(**options) -> saltus.BatchTrajectory:
    """Return cradles of which the first ball is let go at ANGLES."""
    given = {"q": {"swing_0": ANGLES}, "duration": 1.5, "progress": False, **options}
    return saltus.simulate_batch(cradle(), **given)


def test_shapes():
    batch = fan()
    assert len(batch) == 12
    assert batch.t.shape == (151,)
    assert batch.q.shape == batch.v.shape == batch.p.shape == (12, 151, 6)
    for name in ("kinetic", "potential", "shadow", "total"):
        assert getattr(batch, name).shape == (12, 151)
    np.testing.assert_array_equal(batch.total, batch.kinetic + batch.potential)
    np.testing.assert_array_equal(batch.rows, 151)
    assert batch.complete.dtype == bool
    assert batch.complete.all()
    assert batch.failures == {}
    assert batch.coordinate_names == tuple(cradle().coordinate_names)
    assert batch.options.h == 0.01
    assert "12 runs, 0 to 1.5 s" in repr(batch)
    assert "failed" not in repr(batch)


@pytest.mark.parametrize("threads", [2, 3, 8, None])
def test_the_bits_do_not_depend_on_the_threads(threads):
    one, many = fan(threads=1), fan(threads=threads)
    for name in ARRAYS:
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes(), name
    for a, b in zip(one, many, strict=True):
        assert a.impulses.tobytes() == b.impulses.tobytes()


@pytest.mark.parametrize(
    "law", [law for law in saltus.ImpactLaw if law is not saltus.ImpactLaw.custom]
)
def test_each_run_is_what_simulate_gives(law):
    batch = fan(law=law, record_every=4, threads=2)
    for i, run in enumerate(batch):
        alone = saltus.simulate(
            cradle(), {"swing_0": ANGLES[i]}, duration=1.5, law=law, record_every=4, progress=False
        )
        assert isinstance(run, saltus.Trajectory)
        for name in ("t", "q", "v", "p", "kinetic", "shadow", "impacts", "impulses"):
            assert getattr(run, name).tobytes() == getattr(alone, name).tobytes(), name
        assert (run.residual, run.iterations) == (alone.residual, alone.iterations)
        assert batch.energy_error[i] == alone.energy_error == run.energy_error
        assert batch.impacts[i] == len(alone.impacts)
        assert batch.q[i].tobytes() == alone.q.tobytes()
        assert run.summary() == alone.summary()


def test_runs_by_index():
    batch = fan()
    assert batch[-1].q.tobytes() == batch[11].q.tobytes() == batch[np.int64(11)].q.tobytes()
    for wrong in (12, -13):
        with pytest.raises(IndexError, match="the batch has 12"):
            batch[wrong]
    with pytest.raises(TypeError):
        batch["swing_0"]
    np.testing.assert_array_equal(batch.column("swing_0"), batch.q[:, :, 0])
    np.testing.assert_array_equal(batch.column("swing_0", of="v"), batch.v[:, :, 0])
    with pytest.raises(saltus.ModelError, match='no coordinate "swing"; there are swing_0'):
        batch.column("swing")
    with pytest.raises(saltus.ModelError, match='no array "x"'):
        batch.column("swing_0", of="x")


def test_arrays_cannot_be_written():
    batch = fan()
    for name in (*ARRAYS, "rows", "complete"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(batch, name)[0] = 0


def test_start_and_end_only():
    batch = fan(record_every=10**6)
    np.testing.assert_array_equal(batch.t, [0, 1.5])
    np.testing.assert_array_equal(batch.q[:, 1], fan().q[:, -1])


def test_ways_to_say_the_same_starts():
    q = np.zeros((12, 6))
    q[:, 0], q[:, 1] = ANGLES, 0.1
    v = np.tile([0, 0, 0, 0, 0, 0.5], (12, 1))
    states = [cradle().state(*pair) for pair in zip(q, v, strict=True)]
    expected = fan(q=q, v=v)
    for starts in (
        {"q": {"swing_0": ANGLES, "sway_0": 0.1}, "v": {"sway_2": 0.5}},
        {"q": {"swing_0": list(ANGLES), "sway_0": [0.1] * 12}, "v": v[0]},
        {"q": q.tolist(), "v": {"sway_2": [0.5] * 12}},
        {"q": np.asfortranarray(q), "v": np.repeat(v, 2, axis=0)[::2]},
        {"q": None, "states": states},
        {"q": None, "states": tuple(states)},
    ):
        assert fan(**starts).p.tobytes() == expected.p.tobytes()


def test_going_on_where_a_batch_ended():
    half = fan(duration=0.75)
    rest = fan(q=None, states=[run.state(-1) for run in half], duration=0.75)
    assert rest.t[0] == 0.75
    np.testing.assert_allclose(rest.q[:, -1], fan().q[:, -1], atol=1e-9)


OVERLAP = {"swing_0": np.array([0.3, -0.05, 0.2, -0.04])}


def test_failures_stay_with_their_runs():
    with pytest.warns(RuntimeWarning, match="2 of 4 runs failed, see failures; run 1: bodies over"):
        batch = fan(q=OVERLAP)
    assert batch.failures.keys() == {1, 3}
    assert "ball_0 ~ ball_1 by 0.0499636 m" in batch.failures[1]
    np.testing.assert_array_equal(batch.complete, [True, False, True, False])
    np.testing.assert_array_equal(batch.rows, [151, 1, 151, 1])
    assert np.isnan(batch.q[1, 1:]).all()
    assert np.isnan(batch.total[1, 1:]).all()
    assert not np.isnan(batch.q[[0, 2]]).any()
    assert batch.q[2].tobytes() == fan(q={"swing_0": [0.2]}).q[0].tobytes()
    assert len(batch[1]) == 1
    assert "(stopped)" in repr(batch[1])
    assert "4 runs (2 failed)" in repr(batch)


def test_a_step_that_cannot_be_made_keeps_the_rows_before():
    with pytest.warns(RuntimeWarning, match="1 of 2 runs failed"):
        batch = fan(q={"swing_0": [0.0, 0.3]}, max_impulses=1)
    assert "max_impulses" in batch.failures[1]
    assert batch.rows[1] == 51  # the impact is at 0.5046 s
    assert not np.isnan(batch.q[1, :51]).any()
    assert np.isnan(batch.q[1, 51:]).all()
    assert batch.energy_error[1] < 1e-4


@pytest.mark.parametrize("threads", [1, 2, 8])
def test_failures_are_raised_where_asked(threads):
    stop = saltus.OnFailure.stop
    with pytest.raises(saltus.ModelError, match=r"^run 1: bodies overlap"):
        fan(q=OVERLAP, on_failure=stop, threads=threads)
    with pytest.raises(saltus.JammedError, match=r"^run 1: the impact at t = 0\.5") as error:
        fan(on_failure=stop, threads=threads, max_impulses=1)
    assert error.value.t == pytest.approx(0.5, abs=0.01)


NAN = np.zeros((3, 6))
NAN[2, 4] = math.nan


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"q": np.zeros((3, 5))}, r"q has shape \(3, 5\); it must have shape \(runs, 6\).*swing_0"),
        ({"q": np.zeros((3, 4, 6))}, r"q has shape \(3, 4, 6\)"),
        ({"q": NAN}, r'^q\[2, "swing_2"\] = nan is not finite'),
        ({"v": NAN, "q": None}, r'^v\[2, "swing_2"\] = nan is not finite'),
        ({"q": {"swing_0": [0, math.inf]}}, r'^q\[1, "swing_0"\] = inf'),
        ({"q": {"swing": ANGLES}}, "there are swing_0"),
        ({"q": {"swing_0": "up"}}, r'q\["swing_0"\] is no array of numbers'),
        ({"q": {"swing_0": [0, 0], "sway_0": [0]}}, r'"swing_0": \(2,\), "sway_0": \(1,\)'),
        ({"q": {"swing_0": [[0]]}}, r'q\["swing_0"\] has shape \(1, 1\)'),
        ({"q": [[0] * 6, [0] * 5]}, "q is no array of numbers"),
        ({"v": np.zeros((3, 6))}, "q has 12 rows and v has 3"),
        ({"q": None}, "single start"),
        ({"q": np.zeros(6)}, "single start"),
        ({"q": np.zeros((0, 6))}, "no starts"),
        ({"q": None, "states": []}, "no starts"),
        ({"states": [cradle().state()]}, "not both"),
        ({"q": None, "states": [cradle().state(), chain(2).state()]}, r"states\[1\].q has 2"),
        (
            {"q": None, "states": [cradle().state(), cradle().state(t=1.0)]},
            r"states\[1\].t = 1 s, and states\[0\].t = 0 s",
        ),
        ({"threads": 0}, "threads = 0; it must be at least 1"),
        ({"threads": -2}, "threads = -2; it must be at least 1"),
        ({"duration": -1.0}, "duration = -1"),
        ({"duration": 1.0, "h": 0.3}, "the nearest is 0.9"),
        ({"record_every": 0}, "record_every = 0"),
        ({"max_impacts": 0}, "max_impacts = 0"),
        ({"duration": 1e5, "h": 1e-3}, "12 runs of 100000001 rows.* GB, more than 16"),
    ],
)
def test_what_cannot_be_run(options, message):
    parts: list[float] = []
    with pytest.raises(saltus.ModelError, match=message):
        fan(**{"progress": parts.append, **options})
    assert parts == []


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"max_iteration": 1}, r'simulate_batch\(\) has no argument "max_iteration"; bounds'),
        ({"law": 0}, "there are saltus.ImpactLaw.nodal_energy"),
        ({"on_failure": True}, "there are saltus.OnFailure.go_on, saltus.OnFailure.stop"),
        ({"threads": 1.5}, "threads"),
        ({"q": None, "states": [cradle().state(), 1]}, r"states\[1\] is a int; model"),
    ],
)
def test_wrong_arguments_are_type_errors(options, message):
    with pytest.raises(TypeError, match=message):
        fan(**options)


def long_batch(**options) -> saltus.BatchTrajectory:
    """Return what takes about a second."""
    given = {"q": np.full((4, 16), 0.1), "duration": 10.0, "h": 0.002, **options}
    return saltus.simulate_batch(chain(16), **given)


def test_progress_is_told_and_its_errors_come_out():
    parts: list[float] = []
    long_batch(progress=parts.append)
    assert parts == sorted(parts)
    assert all(0 <= part <= 1 for part in parts)
    assert parts[-1] == 1

    def fail(part: float) -> None:
        raise LookupError("in progress")

    with pytest.raises(LookupError, match="in progress"):
        long_batch(duration=1000.0, progress=fail)


def test_a_bar_counts_runs(capfd):
    fan()
    assert capfd.readouterr().err == ""
    fan(progress=True)
    assert "12.00/12.00 runs" in capfd.readouterr().err


def test_other_python_threads_go_on_meanwhile():
    turns = 0
    over = threading.Event()

    def count() -> None:
        nonlocal turns
        while not over.wait(0.001):
            turns += 1

    counting = threading.Thread(target=count)
    counting.start()
    long_batch(threads=1, progress=False)
    before_the_end = turns
    over.set()
    counting.join()
    assert before_the_end > 10


INTERRUPTED = """
    import signal
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores it
    import numpy as np, saltus
    model = saltus.load_urdf(saltus.scenes.chain(16))
    def tell(part):
        print("running", flush=True)
    batch = saltus.simulate_batch(model, q=np.full((5, 16), 0.1), duration=1e5, h=0.001,
                                  record_every=1000, threads=2, progress=tell)
    print(batch.complete.any(), len(batch.failures), *batch.rows, np.isnan(batch.q[0, -1, 0]))
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
    complete, failures, *rows, nan = out.splitlines()[-1].split()
    assert (complete, failures, nan) == ("False", "0", "True")
    assert min(map(int, rows)) == 1  # runs that never began hold their start
    assert "saltus: stopped; 5 of 5 runs had not ended" in err
