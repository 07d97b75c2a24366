"""Far from the origin a gap is known to some ulp of the coordinates: impacts are where they are."""

from __future__ import annotations

import math

import numpy as np
import pytest

import saltus

TILT, RADIUS = 0.3, 0.1


@pytest.mark.parametrize("x", [0, 1e3, 1e5, 1e6, 1e7])
@pytest.mark.parametrize("restitution", [1, 0.5])
def test_a_ball_falls_on_a_slope(x, restitution):
    normal = (math.sin(TILT), 0, math.cos(TILT))
    builder = saltus.ModelBuilder().add_half_space("slope", normal, math.sin(TILT) * x)
    builder.set_default_contact(restitution=restitution, friction=0)
    builder.add_body("ball", saltus.Sphere(RADIUS), mass=1, joint_name="free")
    model = builder.build()
    run = saltus.simulate(model, q={"free_x": x, "free_z": 1}, duration=0.6, progress=False)
    height = 1 - RADIUS / math.cos(TILT)
    np.testing.assert_allclose(run.impacts["t"], math.sqrt(2 * height / 9.81), atol=1e-8)
    assert len(run.fallbacks) == 0
    # some ulp of the coordinates
    assert min(model.gaps(q).phi.min() for q in run.q) > -1e-10 - 8 * np.finfo(float).eps * x


@pytest.mark.parametrize("x", [0, 1e3, 1e5, 1e7])
def test_a_box_comes_to_rest(x):
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0.3, friction=0.5)
    builder.add_body("box", saltus.Box((0.1, 0.1, 0.1)), mass=1, joint_name="free")
    start = {"q": {"free_x": x, "free_z": 0.3}, "v": {"free_wx": 2.0}}
    run = saltus.simulate(builder.build(), **start, duration=2, progress=False)
    assert np.abs(run.v[-1]).max() < 1e-9
    assert run.q[-1][2] == pytest.approx(0.1, abs=1e-9)
    assert (np.diff(run.total) < 1e-3 * run.kinetic.max()).all()
