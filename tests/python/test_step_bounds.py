"""A step ends, by its state or by an error that says why. Starts found by random throws."""

from __future__ import annotations

import re

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
