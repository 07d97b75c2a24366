"""A step ends, by its state or by an error that says why. Starts found by random throws."""

from __future__ import annotations

import re
from itertools import pairwise

import saltus

CAN = saltus.Cylinder(0.1, 0.1)

# fmt: off
CANS_Q = [
    -0.08295563545465022, -0.5651468043026128, 0.2608199874092443,
    -0.2895114649776263, -0.20586092201574188, 0.7892762570480749, 0.5008466656507943,
    0.07938423738581384, -0.5552809554958059, 0.398063232960715,
    -0.667759464253064, 0.6264770084235505, 0.16059243132014198, 0.3685565449423267,
]
CANS_V = [
    0.7805756600299093, -1.3336910409064289, -0.7725635621850802,
    5.825119818866359, -17.242136033333693, 4.748092315318248,
    2.963485123192974, -0.8209777279366886, -1.6858671547960555,
    -17.00014121314708, -3.755073612017148, -3.8820469251641136,
]
# fmt: on


def cans_in_a_groove() -> saltus.Model:
    builder = saltus.ModelBuilder("cans")
    for name in ("a", "b"):
        builder.add_body(name, CAN, mass=1)
    builder.add_half_space("left", (1, 0, 1)).add_half_space("right", (-1, 0, 1))
    return builder.set_default_contact(restitution=0.5, friction=0).build()


def test_arcs_that_lead_nowhere_end():
    """Two cans graze, axis on axis: arcs of 1e-18 s, none of them with an impact, had no bound."""
    model = cans_in_a_groove()
    state = model.state(CANS_Q, CANS_V)
    stepper = saltus.Stepper(model, h=0.005, max_impacts=50)
    before = state.q.copy(), state.p.copy()
    try:
        stepper.advance(state)
    except saltus.StepError as error:
        text = str(error)
        assert re.search(r"\d+ arcs but \d+ impacts in the step from t = 0 s", text)
        assert "a[" in text
        assert "b[" in text
        assert (state.q == before[0]).all()
        assert (state.p == before[1]).all()
    else:  # it may pass one day
        assert stepper.report.arcs <= 2 * stepper.options.max_impacts + 2 * 64


def wall_of_bricks(rows: int, columns: int) -> tuple[saltus.Model, saltus.State]:
    """Return a wall without mortar, of which each brick lies on two, and a ball that hits it."""
    builder = saltus.ModelBuilder().add_floor().set_default_contact(restitution=0, friction=0.6)
    for row in range(rows):
        for column in range(columns):
            X = saltus.Pose((0, 0.2 * column + 0.1 * (row % 2), 0.05 + 0.1 * row))
            builder.add_body(f"{row}_{column}", saltus.Box((0.05, 0.1, 0.05)), mass=2, X=X)
    X = saltus.Pose((0.5, 0.45, 0.35))
    builder.add_body("ball", saltus.Sphere(0.08), mass=3, X=X, joint_name="ball")
    model = builder.build()
    return model, model.state(v={"ball_vx": -5.0})


def test_the_step_in_which_a_wall_is_hit_is_exact():
    """Contacts of a brick that slides contradicted each other in the direction of their friction.

    So the closing kick had no impulses, and the step was halved to the last: 50 s of CPU.
    """
    model, state = wall_of_bricks(6, 5)
    stepper = saltus.Stepper(model, h=0.005)
    hits = 0
    while state.t < 0.0749:  # the step from 0.07 s on has the hit
        state = stepper.advance(state)
        hits += len(stepper.report.impacts)
        assert len(stepper.report.fallbacks) == 0
    assert hits > 0


def test_edges_that_lie_along_each_other_have_arcs():
    """Where nearly parallel edges cross is anywhere on them, and so was the normal that held them.

    Steps of a wall that falls apart are halved at the worst; they went on to time stepping.
    """
    model, state = wall_of_bricks(4, 3)
    stepper = saltus.Stepper(model, h=0.005)
    energy = [model.kinetic_energy(state) + model.potential_energy(state.q)]
    arcs = []
    for _ in range(18):
        state = stepper.advance(state)
        arcs.append(stepper.report.arcs)
        assert {fallback[2] for fallback in stepper.report.fallbacks} <= {"halved"}
        energy.append(model.kinetic_energy(state) + model.potential_energy(state.q))
    assert max(arcs) <= 2 * 64
    # contacts take energy; a midpoint may swing by (h omega)^2 / 8 of it
    assert all(after <= before * (1 + 1e-3) for before, after in pairwise(energy))
    assert model.gaps(state.q).phi.min() > -1e-9  # what is not moved apart, 1e-8 of the bricks
