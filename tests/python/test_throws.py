"""Bodies thrown on a floor at random: every throw ends, nothing sinks, contacts give no energy."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import thrown
from tests.bench.throws import random_scene

import saltus

H, DURATION = 0.005, 3.0
SHAPES = {
    "box": saltus.Box((0.1, 0.2, 0.3)),
    "cube": saltus.Box((0.1, 0.1, 0.1)),
    "can": saltus.Cylinder(0.1, 0.1),
    "capsule": saltus.Capsule(0.1, 0.2),
    "ball": saltus.Sphere(0.1),
    "ellipsoid": saltus.Ellipsoid((0.1, 0.15, 0.2)),
}
MATERIALS = ((0, 0), (0.3, 0.5), (0.5, 0), (0.9, 0.2), (0, 0.8))  # restitution, friction


def throw(shape: str, restitution: float, friction: float, rng: np.random.Generator):
    """Return the model and the run of one body: any attitude, up to 10 rad/s about any axis."""
    model = thrown(SHAPES[shape], restitution=restitution, friction=friction)
    attitude, axis = rng.normal(size=4), rng.normal(size=3)
    q = model.normalized([0, 0, rng.uniform(0.5, 1), *attitude / np.linalg.norm(attitude)])
    spin = rng.uniform(0, 10) * axis / np.linalg.norm(axis)
    v = [*rng.uniform(-2, 2, 3), *spin]
    return model, saltus.simulate(model, q=q, v=v, duration=DURATION, h=H, progress=False)


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("shape", SHAPES)
def test_throws(shape, material):
    rng = np.random.default_rng([list(SHAPES).index(shape), MATERIALS.index(material)])
    for _ in range(10):
        model, run = throw(shape, *material, rng)
        assert run.complete
        # a hundredth of what touches (1e-10 of the size), and rounding
        assert min(model.gaps(q).phi.min() for q in run.q) > -1e-10
        # A midpoint swings by (h omega)^2 / 8, with 14 rad/s on landing 6e-4; an arc that contacts
        # hold may swing by 0.02 of what moves before it is made of shorter ones.
        rise = (run.total - np.minimum.accumulate(run.total)).max()
        assert rise <= 0.025 * run.kinetic.max()


def test_a_thrown_body_and_one_that_rests():
    """Of no friction, both: the one that rests is held in every arc of the one that tumbles."""
    for seed in range(20):
        builder = saltus.ModelBuilder().add_floor()
        builder.set_default_contact(restitution=0.5, friction=0)
        builder.add_body("thrown", SHAPES["box"], mass=1, X=saltus.Pose((0, 0, 1)))
        builder.add_body("rests", saltus.Box((0.5,) * 3), mass=1, X=saltus.Pose((3, 0, 0.5)))
        spin = np.random.default_rng(seed).uniform(-5, 5, 3)
        v = {"thrown": ((-1, 0, 0), spin)}
        run = saltus.simulate(builder.build(), v=v, duration=2, h=H, progress=False)
        assert run.complete
        assert len(run.fallbacks) == 0


def test_a_rim_that_passes_an_edge_ends_no_arc():
    """Where a rim is on a rim or an edge, crossings have the contact: it used to end 100 arcs.

    An ellipsoid and two cans in a pit, a throw of the benchmark (two seconds, 400 steps).
    """
    scene = random_scene(21, 11)
    stepper, state, most = saltus.Stepper(scene.model, scene.h), scene.state, 0
    for _ in range(400):
        state = stepper.advance(state)
        most = max(most, stepper.report.arcs)
        assert not stepper.report.fallbacks
    assert most <= 10  # a few impacts
