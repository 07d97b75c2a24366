"""A can that is let go on its rim tips until its cap slaps down: by arcs that end at the slap."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

H, RADIUS, HALF = 0.005, 0.1, 0.1


def let_go(tilt: float, azimuth: float, restitution: float, friction: float, duration: float = 0.3):
    """Return the run of a can at rest on the lowest point of its rim, at this place on the rim."""
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=restitution, friction=friction)
    model = builder.add_body("can", saltus.Cylinder(RADIUS, HALF), mass=1).build()
    height = HALF * np.cos(tilt) + RADIUS * np.sin(tilt)
    axis = np.array([np.cos(azimuth), np.sin(azimuth), 0])
    q = model.normalized([0, 0, height, *np.sin(tilt / 2) * axis, np.cos(tilt / 2)])
    return saltus.simulate(model, q=q, duration=duration, h=H, progress=False)


@pytest.mark.parametrize("azimuth", [0, 0.3])  # 0: one of the points that are watched on the rim
@pytest.mark.parametrize("tilt", [0.5, 0.2, 0.05, 0.01])
@pytest.mark.parametrize("restitution", [0, 0.5, 0.9, 1])
@pytest.mark.parametrize("friction", [0, 0.5])
@pytest.mark.filterwarnings("ignore::saltus.StepWarning")
def test_it_slaps_down(azimuth, tilt, restitution, friction):
    run = let_go(tilt, azimuth, restitution, friction)
    lossy = run.fallbacks["tau"][run.fallbacks["rung"] != "halved"]
    # what friction turns within the arc that the rim passes level in; it was up to 25 of 60 steps
    assert lossy.sum() <= (0.01 * run.t[-1] if friction > 0 else 0)
    assert len(run.impacts) > 0
    assert min(run.model.gaps(q).phi.min() for q in run.q) > -1e-10
    # midpoints swing by (h omega)^2 / 8, 2e-4 of what moves at 7 rad/s; a rim that friction turns
    # as it passes level by more
    assert (run.total - np.minimum.accumulate(run.total)).max() < 2e-3 * run.kinetic.max()


@pytest.mark.parametrize("azimuth", [0, 0.3])
def test_an_elastic_slap_keeps_its_energy(azimuth):
    run = let_go(0.5, azimuth, 1, 0)
    assert np.ptp(run.total) < 3e-4 * run.kinetic.max()
    landing = run.impacts["t"][0]
    assert landing < 0.15
    after = run.v[int(landing / H) + 2]
    assert after[2] > 0.5  # it leaps


def test_a_point_of_the_rim_is_no_contact_beside_the_rim():
    """Two equal rows would change roles from step to step."""
    for tilt in (0.5, 0.05):
        run = let_go(tilt, 0, 0, 0.5, duration=0.02)
        stepper = saltus.Stepper(run.model, h=H)
        stepper.advance(run.state(2))
        assert len(stepper.report.contacts) == 1
