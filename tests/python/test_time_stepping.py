"""Arcs that nothing else finds are made by time stepping: they end, lose energy and say so."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest

import saltus

H = 0.005


def throw_in_a_groove(seed: int, *, restitution: float = 0.5, friction: float = 0, **options):
    """Return the run of a coin that is thrown into a groove of 90 degrees: its caps slap flat."""
    rng = np.random.default_rng(seed)
    builder = saltus.ModelBuilder().add_body("coin", saltus.Cylinder(0.1, 0.02), mass=1)
    builder.add_half_space("left", (1, 0, 1)).add_half_space("right", (-1, 0, 1))
    builder.set_default_contact(restitution=restitution, friction=friction)
    model = builder.build()
    q = model.normalized([0, 0, 1, *rng.normal(size=4)])
    v = [*rng.uniform(-2, 2, 3), *rng.uniform(-5, 5, 3)]
    return saltus.simulate(model, q=q, v=v, duration=2, h=H, progress=False, **options)


@pytest.fixture(scope="module")
def runs():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", saltus.StepWarning)
        return [throw_in_a_groove(seed) for seed in range(40)]


def lossy(run: saltus.Trajectory) -> np.ndarray:
    return run.fallbacks[run.fallbacks["rung"] != "halved"]


def test_all_end_and_nothing_sinks_or_gains(runs):
    for run in runs:
        assert run.complete
        assert min(run.model.gaps(q).phi.min() for q in run.q) > -1e-10
        # a midpoint swings by (h omega)^2 / 8, and an arc that contacts hold by 0.02 at most
        rise = (run.total - np.minimum.accumulate(run.total)).max()
        assert rise <= 0.025 * run.kinetic.max()


def test_it_is_used_and_rare(runs):
    steps = [len(np.unique((lossy(run)["t"] / H + 1e-9).astype(int))) for run in runs]
    assert 0 < sum(steps) <= 0.01 * sum(len(run) for run in runs)
    for run in runs:
        rows = lossy(run)
        assert set(rows["rung"]) <= {"unlocated"}
        assert (rows["tau"] <= H / 64 * (1 + 1e-12)).all()
        assert (rows["energy"] <= 1e-12).all()
        assert (rows["pair"] >= 0).all()
        assert ("by time stepping" in run.summary()) == (len(rows) > 0)


def test_one_warning_a_run(runs):
    seed = next(i for i, run in enumerate(runs) if len(lossy(run)))
    with pytest.warns(
        saltus.StepWarning, match="by time stepping, which took .* J: the first"
    ) as w:
        throw_in_a_groove(seed)
    assert len([each for each in w if each.category is saltus.StepWarning]) == 1


def test_strict_runs_end_in_an_error_instead(runs):
    """Where one halving is all they may try; with six of them none has to."""
    texts = []
    for seed, run in enumerate(runs):
        if len(lossy(run)) > 0:
            try:
                throw_in_a_groove(seed, strict=True, max_halvings=1)
            except saltus.StepError as error:
                texts.append(str(error))
    assert any(re.search(r"arcs of .* s fail as well", text) for text in texts)


def test_the_report_and_the_file_have_them(runs, tmp_path):
    run = next(run for run in runs if len(lossy(run)))
    row = lossy(run)[0]
    step = int(row["t"] / H + 1e-9)
    stepper = saltus.Stepper(run.model, h=H)
    stepper.advance(run.state(step))
    told = [each for each in stepper.report.fallbacks if each[2] == "unlocated"]
    assert told
    assert told[0][4] in run.model.pair_names
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5", model=run.model)
    np.testing.assert_array_equal(again.fallbacks, run.fallbacks)


def test_a_batch_warns(runs):
    seed = next(i for i, run in enumerate(runs) if len(lossy(run)))
    run = runs[seed]
    with pytest.warns(saltus.StepWarning, match="2 of 2 runs have arcs by time stepping"):
        saltus.simulate_batch(run.model, states=[run.state(0)] * 2, duration=2, h=H, progress=False)


def test_elastic_bodies_lose_nothing():
    """Where all contacts rebound in full, bounces without end stay an error."""
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=1, friction=0)
    model = builder.add_body("ball", saltus.Sphere(0.1), mass=1).build()
    start = {"q": model.normalized([0, 0, 0.1, 0, 0, 0, 1]), "v": [0, 0, 0.005, 0, 0, 0]}
    with pytest.raises(saltus.StepError, match="more than 3 impacts"):
        saltus.simulate(model, **start, duration=0.1, h=0.01, max_impacts=3)


def test_free_bodies_lose_nothing():
    """A chain that h is too long for is no matter of contacts."""
    chain = saltus.load_urdf(saltus.scenes.chain(20))
    with pytest.raises(saltus.StepError, match="DEL residual"):
        saltus.simulate(chain, q=[0.5] * 20, duration=50, h=0.5, max_halvings=0)
