"""Scenes at random, on fixed seeds: every step ends, contacts give no energy, nothing sinks."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import saltus

PLACES = {
    "floor": [(0, 0, 1)],
    "groove": [(1, 0, 1), (-1, 0, 1)],
    "pit": [(1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1)],
}
JOINTS = ("revolute", "prismatic", "continuous", "floating", "planar", "spherical")


def random_shape(rng: np.random.Generator, size: float) -> object:
    a, b, c = size * rng.uniform(0.4, 1, 3)
    points = rng.normal(size=(int(rng.integers(5, 11)), 3))
    points *= size / np.linalg.norm(points, axis=1)[:, None]
    shapes = (
        saltus.Box((a, b, c)),
        saltus.Cylinder(a, b),
        saltus.Capsule(a / 2, b),
        saltus.Sphere(a),
        saltus.Ellipsoid((a, b, c)),
        saltus.Convex(points),
    )
    return shapes[int(rng.integers(len(shapes)))]


def turned(rng: np.random.Generator) -> np.ndarray:
    """Return the rotation matrix of a random attitude."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q if np.linalg.det(q) > 0 else -q


def free_bodies(seed: int) -> tuple[saltus.Model, saltus.State, dict]:
    """Return one to three bodies over a floor, a groove or a pit."""
    rng = np.random.default_rng([1, seed])
    builder = saltus.ModelBuilder()
    for i, normal in enumerate(PLACES[str(rng.choice(list(PLACES)))]):
        builder.add_half_space(f"plane_{i}", normal)
    e, mu = float(rng.choice([0, 0.3, 0.5, 0.9])), float(rng.choice([0, 0.2, 0.8, 2]))
    builder.set_default_contact(restitution=e, friction=mu)
    q, v = [], []
    for i in range(int(rng.integers(1, 4))):
        mass = float(10 ** rng.uniform(-1, 1))
        builder.add_body(f"body_{i}", random_shape(rng, 0.15), mass=mass)
        q += [*rng.uniform(-0.05, 0.05, 2), 0.35 + 0.4 * i, *rng.normal(size=4)]
        v += [*rng.uniform(-2, 2, 3), *rng.uniform(-10, 10, 3)]
    model = builder.build()
    return model, model.state(model.normalized(q), v), {"h": float(rng.choice([0.005, 0.01]))}


def trees(seed: int) -> tuple[saltus.Model, saltus.State, dict]:
    """Return up to four links in trees on joints of every kind, in a box or in the open."""
    rng = np.random.default_rng([2, seed])
    builder = saltus.ModelBuilder().set_gravity((0, 0, -9.81 * int(rng.integers(2))))
    builder.set_default_contact(
        restitution=float(rng.choice([0, 0.3, 0.9, 1])), friction=float(rng.choice([0, 0.2, 1]))
    )
    for k in range(int(rng.integers(0, 4))):
        normal = (0, 0, 1) if k == 0 else rng.normal(size=3)
        builder.add_half_space(f"wall_{k}", normal, -float(rng.uniform(0.8, 1.5)))
    parents = ["world"]
    for i in range(int(rng.integers(1, 5))):
        size, parent = float(rng.uniform(0.05, 0.3)), str(rng.choice(parents))
        joint = str(rng.choice(JOINTS))
        place = rng.normal(size=3)
        place *= (0.7 if parent == "world" else 0.6) / np.linalg.norm(place)
        builder.add_body(
            f"link_{i}", random_shape(rng, size), mass=float(10 ** rng.uniform(-1, 1)),
            joint=getattr(saltus.JointType, joint), joint_name=f"joint_{i}", parent=parent,
            X=saltus.Pose(place, turned(rng)),
            **({"axis": rng.normal(size=3)} if joint in JOINTS[:3] or joint == "planar" else {}),
        )  # fmt: skip
        parents.append(f"link_{i}")
    model = builder.build()
    q = model.integrate(model.neutral(), rng.uniform(-0.5, 0.5, model.n_v))
    v = rng.normal(size=model.n_v) * float(rng.choice([0, 1, 3]))
    options = {
        "h": float(rng.choice([0.001, 0.005])),
        "law": str(rng.choice(["nodal_energy", "discrete_energy", "shadow_energy"])),
        "order": str(rng.choice(["fastest", "index", "symmetric"])),
    }
    return model, model.state(saltus.resolve_overlap(model, q), v), options


def expect_a_right_run(make, seed: int, steps: int) -> None:
    try:
        model, state, options = make(seed)
    except saltus.ModelError:
        return  # links that no joint moves out of each other
    h = options["h"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", saltus.StepWarning)
        run = saltus.simulate(model, state=state, duration=steps * h, progress=False, **options)
    assert np.isfinite(run.q).all(), seed
    if model.n_pairs:
        assert min(model.gaps(q).phi.min() for q in run.q[::10]) > -1e-8, seed
    # a midpoint swings by (h omega)^2 / 8; an arc that contacts hold by 0.02 at most before it is
    # made of shorter ones. What is not of contacts is no matter of this test: trees swing, too
    rise = (run.total - np.minimum.accumulate(run.total)).max()
    assert rise <= 0.1 * run.kinetic.max() + 1e-9, seed


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 300, 50))
def test_free_bodies(first):
    for seed in range(first, first + 50):
        expect_a_right_run(free_bodies, seed, 60)


@pytest.mark.parametrize("first", range(0, 300, 50))
def test_trees(first):
    for seed in range(first, first + 50):
        expect_a_right_run(trees, seed, 120)
