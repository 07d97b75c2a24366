"""Bodies thrown on a floor at random: every throw ends, nothing sinks, contacts give no energy."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import thrown
from tests.bench import contact
from tests.bench.contact_scenes import galton
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


# fmt: off
RIM_Q = [
    -0.06120756634330823, -0.06824895058507498, 0.14887637208544327,
    -0.2354527837954026, 0.5230061987805085, 0.10240010899447247,
    -0.8127365626807241, 0.01460033662210917, -0.07768824764280814,
    0.22136326329321623, -0.8645116800766667, -0.04964506550597084,
    0.40102292197339945, 0.2988905126193265,
]
RIM_P = [
    0.24398333771940026, 0.27053636344293136, -0.25925136457299364,
    -0.008002466229876343, -0.009586056108275995, -0.0192006197345857,
    0.062477611756295626, 0.22190540596377625, -0.1231758669940706,
    0.00014423364170268097, -0.009526997162173072, -0.001236976782287942,
]
# fmt: on


def test_a_rim_that_lies_on_an_edge_ends_no_arc():
    """Where it goes in and comes out the edge bears it: its lowest point used to end 100 arcs.

    A hull and a can in a pit, a throw of the benchmark after 1.130 s.
    """
    scene = random_scene(11, 337)
    stepper = saltus.Stepper(scene.model, scene.h)
    stepper.advance(saltus.State(t=1.129999999999998, q=RIM_Q, p=RIM_P))
    assert stepper.report.arcs <= 10  # a few impacts
    assert not stepper.report.fallbacks


def thrown_on_a_plank(seed: int, *, restitution: float, friction: float):
    """Return the model and the state of a can that falls on a plank's edges and the floor."""
    rng = np.random.default_rng(seed)
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=restitution, friction=friction)
    builder.add_body("can", saltus.Cylinder(0.1, 0.1), mass=1)
    plank = saltus.Box((0.3, 0.1, 0.1))
    builder.add_body("plank", plank, mass=2, X=saltus.Pose((0, 0, 0.1)))
    model = builder.build()
    place, attitude = [*rng.uniform(-0.2, 0.2, 2), 0.45], rng.normal(size=4)
    q, v = model.state().q.copy(), np.zeros(model.n_v)
    q[:7] = [*place, *attitude / np.linalg.norm(attitude)]
    v[:6] = [*rng.uniform(-1, 1, 3), *rng.uniform(-5, 5, 3)]
    return model, model.state(q, v)


def most_arcs(model: saltus.Model, state: saltus.State, duration: float) -> int:
    """Return the most arcs of a step; none falls back, no whole body sinks."""
    stepper, most = saltus.Stepper(model, H), 0
    for _ in range(round(duration / H)):
        state = stepper.advance(state)
        most = max(most, stepper.report.arcs)
        assert not stepper.report.fallbacks
        # a hundredth of what touches (1e-10 of the size), and rounding
        assert model.gaps(state.q).phi.min() > -1e-10
    return most


def test_a_rim_that_an_edge_bears_ends_arcs_where_it_sinks():
    """Its gap is that of the edge's crossing, 0: found to close in no time, it ended 148 arcs."""
    model, state = thrown_on_a_plank(5, restitution=0.3, friction=0.2)
    assert most_arcs(model, state, 1) <= 10  # a few impacts


@pytest.mark.parametrize("seed", [0, 4, 6])
def test_what_comes_back_by_the_bend_of_its_path_comes_to_rest(seed):
    """A cube on an egg: its edge leaves, and turns back, in hops each of .3 of the last."""
    rng = np.random.default_rng(seed)
    builder = saltus.ModelBuilder()
    for k, normal in enumerate([(1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1)]):
        builder.add_half_space(f"plane_{k}", normal)
    builder.set_default_contact(restitution=0.3, friction=0)
    builder.add_body("cube", SHAPES["cube"], mass=1)
    builder.add_body("egg", SHAPES["ellipsoid"], mass=1)
    model = builder.build()
    q = model.state().q.copy()
    q[:3], q[7:10] = [*rng.uniform(-0.1, 0.1, 2), 0.4], [*rng.uniform(-0.1, 0.1, 2), 0.8]
    for k in (3, 10):
        q[k : k + 4] = rng.normal(size=4)
    state = model.state(model.normalized(q), rng.uniform(-2, 2, model.n_v))
    assert most_arcs(model, state, 1.2) <= 10  # 65, 102 and 124 before


def test_what_a_longer_arc_missed_is_watched_on_the_shorter_one():
    """Fifty balls among pegs: two steps ended with balls .04 mm in each other, and were halved."""
    board = galton(50)
    model, starts = contact.model_of(board), np.array([ball.place for ball in board.bodies])
    stepper, state = saltus.Stepper(model, contact.H), model.state()
    for _ in range(36):
        state = stepper.advance(state)
        assert not stepper.report.fallbacks
        places = starts + state.q.reshape(50, 7)[:, :3]
        apart = np.linalg.norm(places[:, None] - places, axis=2)[np.triu_indices(50, 1)]
        assert apart.min() > 0.04 - 1e-10  # a touch is 1e-10 of the size
