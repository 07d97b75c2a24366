"""What rests stays where it is and costs next to nothing; slow closings rest where they meet."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

G = 9.81


def tower(boxes: int) -> saltus.Model:
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0, friction=0.5)
    for i in range(boxes):
        X = saltus.Pose((0, 0, 0.1 * (2 * i + 1)))
        builder.add_body(f"box_{i}", saltus.Box((0.2, 0.15, 0.1)), mass=1, X=X)
    return builder.build()


def apart(boxes: int, *, first: int = 0) -> saltus.Model:
    """Return boxes that slide apart from each other, from number `first` on."""
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0, friction=0.3)
    for i in range(first, boxes):
        X = saltus.Pose((0.7 * i, 0, 0.1))
        builder.add_body(
            f"box_{i}", saltus.Box((0.1,) * 3), mass=1 + i, X=X, joint_name=f"free_{i}"
        )
    return builder.build()


def ball(restitution: float) -> saltus.Model:
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=restitution)
    return builder.add_body("ball", saltus.Sphere(0.1), mass=1, joint_name="free").build()


def test_a_tower_stays_to_rounding_and_is_solved_at_once():
    model = tower(6)
    stepper, start = saltus.Stepper(model, h=0.01), model.state()
    state, iterations = start, []
    for _ in range(500):
        state = stepper.advance(state)
        iterations.append(stepper.report.iterations)
    # positions of 1 m are known to 1e-16, and rounding may walk
    assert np.abs(state.q - start.q).max() < 1e-14
    # one look at the arc where nothing has changed; rounding asks for another now and then
    assert np.mean(iterations[100:]) < 1.1


def test_a_tower_leans_on_what_it_is_and_not_on_what_was():
    """A stepper that knows the steps before goes where a new one goes."""
    model = tower(4)
    stepper, state = saltus.Stepper(model, h=0.01), model.state()
    for _ in range(50):
        state = stepper.advance(state)
    known, fresh = stepper.advance(state), saltus.Stepper(model, h=0.01).advance(state)
    # the impulses of redundant contacts may differ; motion does not
    assert known.q == pytest.approx(fresh.q, abs=1e-13)
    assert known.p == pytest.approx(fresh.p, abs=1e-13)


def test_bodies_that_do_not_meet_do_not_feel_each_other():
    many, one = apart(5), apart(5, first=4)
    v = {f"free_{i}_vx": 0.5 + 0.2 * i for i in range(5)}
    together = saltus.simulate(many, v=v, duration=0.4, progress=False)
    alone = saltus.simulate(one, v={"free_4_vx": v["free_4_vx"]}, duration=0.4, progress=False)
    # others may ask for one more look at the arc, which changes what is rounding
    assert together.q[:, -7:] == pytest.approx(alone.q, abs=1e-13)


@pytest.mark.parametrize("restitution", [0.0, 0.3])
def test_a_slow_closing_is_at_rest_where_it_meets(restitution):
    height = 2e-5  # 2 cm/s, of 10 cm/s that gravity gives in a step
    run = saltus.simulate(ball(restitution), q={"free_z": 0.1 + height}, duration=0.1, h=0.01)
    assert len(run.impacts) == 0
    hits = np.sqrt(2 * height / G)
    bounces = 2 * restitution / (1 - restitution) * hits
    # the discrete parabola is the exact one
    assert run.settlings["t"] == pytest.approx([hits + bounces], abs=1e-9)
    # in the one arc that it closes in it is lowered by less than it was high
    assert run.q[2:, 2] == pytest.approx(0.1, abs=1e-12)
    assert np.abs(run.v[2:]).max() < 1e-12
    assert np.diff(run.total).max() <= 1e-12


@pytest.mark.parametrize(("restitution", "height"), [(0.0, 1e-2), (0.9, 2e-4), (1.0, 2e-5)])
def test_a_closing_that_a_step_can_follow_is_an_impact(restitution, height):
    """It is fast, or bounces for longer than half a step, or loses nothing."""
    run = saltus.simulate(ball(restitution), q={"free_z": 0.1 + height}, duration=0.1, h=0.01)
    first = run.impacts["t"][0]
    assert first == pytest.approx(np.sqrt(2 * height / G), abs=1e-9)


def test_a_heap_takes_few_arcs():
    """Its slow closings cut no arcs of others."""
    rng = np.random.default_rng(3)
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0.3, friction=0.3)
    for normal in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)):
        builder.add_half_space(f"wall_{normal}", normal, -0.2)
    for i in range(8):
        at = np.array([i % 2, i // 2 % 2, i // 4]) * 0.105 + rng.uniform(-0.002, 0.002, 3)
        at[2] += 0.1
        builder.add_body(f"ball_{i}", saltus.Sphere(0.05), mass=1, X=saltus.Pose(at))
    model = builder.build()
    stepper, state, arcs = saltus.Stepper(model, h=0.01), model.state(), []
    for _ in range(60):
        state = stepper.advance(state)
        arcs.append(stepper.report.arcs)
    assert np.mean(arcs[-30:]) < 2  # 9 where every closing is located
