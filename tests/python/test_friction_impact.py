"""`resolve_impact` with friction: a ball on a floor in closed form, energy, errors."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

INERTIA = 0.4  # of a ball of mass 1 and radius 1: 2/5
BALL = {  # x, z, turn about y; its lowest point moves with x' - turn'
    "M": np.diag([1.0, 1.0, INERTIA]),
    "N": [[0.0, 1.0, 0.0]],
    "T": [[1.0, 0.0, -1.0], [0.0, 0.0, 0.0]],
}
GIVES_WAY = 1 + 1 / INERTIA  # of the point that touches, by an impulse on it


def test_a_ball_that_slides_throughout():
    e, mu = 0.5, 0.1
    out = saltus.resolve_impact(**BALL, v=[5.0, -1.0, 0.0], restitution=e, friction=mu)
    lost = mu * (1 + e)  # mu lambda
    np.testing.assert_allclose(out.v, [5 - lost, e, lost / INERTIA], rtol=1e-15)
    assert isinstance(out, saltus.FrictionOutcome)
    assert out.impulses["pair"].tolist() == [0]
    assert out.impulses["lambda"] == pytest.approx([1 + e], rel=1e-15)
    np.testing.assert_allclose(out.impulses["tangential"], [[-lost, 0]], rtol=1e-15)
    assert repr(out).endswith(", 1 impulse)")


def test_a_ball_that_sticks_rolls_off():
    out = saltus.resolve_impact(**BALL, v=[0.7, -1.0, 0.0], restitution=0.5, friction=0.9)
    np.testing.assert_allclose(out.v, [0.5, 0.5, 0.5], rtol=1e-15)  # 5/7 of its speed
    np.testing.assert_allclose(out.impulses["tangential"], [[-0.7 / GIVES_WAY, 0]], rtol=1e-15)


def test_a_ball_that_slides_first_and_rolls_in_the_expansion():
    e, mu = 1.0, 0.2
    came = 1.5 * mu * GIVES_WAY  # compression and half of the expansion stop the sliding
    out = saltus.resolve_impact(**BALL, v=[came, -1.0, 0.0], restitution=e, friction=mu)
    assert out.v[0] - out.v[2] == pytest.approx(0, abs=1e-15)
    assert out.v[0] == pytest.approx(came - 1.5 * mu, rel=1e-15)


def test_without_friction_both_ways_agree():
    plain = saltus.resolve_impact(BALL["M"], BALL["N"], [5.0, -1.0, 2.0])
    smooth = saltus.resolve_impact(**BALL, v=[5.0, -1.0, 2.0], friction=0)
    assert isinstance(plain, saltus.ImpactOutcome)
    assert smooth.v.tolist() == plain.v.tolist()


def test_one_friction_for_each_contact():
    both = {
        "M": np.eye(4),
        "N": [[0, 1, 0, 0], [0, 0, 0, 1]],
        "T": [[1, 0, 0, 0], [0] * 4, [0, 0, 1, 0], [0] * 4],
        "v": [3, -1, 3, -1],
    }
    out = saltus.resolve_impact(**both, friction=[0.1, 0.2], restitution=[0, 1])
    np.testing.assert_allclose(out.v, [2.9, 0, 2.6, 1], atol=1e-15)


def test_energy_never_grows():
    random = np.random.default_rng(7)
    worst = 0.0
    for _ in range(300):
        n, m = 9, int(random.integers(1, 4))
        root = random.normal(size=(n, n))
        M = root @ root.T + 0.1 * np.eye(n)
        rows = random.normal(size=(3 * m, n))
        v = random.normal(size=n)
        out = saltus.resolve_impact(
            M,
            rows[:m],
            v,
            T=rows[m:],
            restitution=random.uniform(size=m),
            friction=random.uniform(0, 1, size=m),
        )
        assert (rows[:m] @ out.v).min() > -1e-9 * np.abs(rows[:m] @ v).max()
        worst = max(worst, (out.v @ M @ out.v) / (v @ M @ v))
    assert worst <= 1 + 1e-12


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"friction": None}, "T is given without friction, one mu or one for each contact"),
        ({"T": None}, "friction is given without T, two rows a contact: T v is the velocity along"),
        ({"T": [[1.0, 0.0, 0.0]]}, "T is (1, 3); N is (1, 3), so T is (2, 3), two rows a contact"),
        ({"friction": [0.1, 0.2]}, "friction has 2 entries; N has 1"),
        ({"friction": -0.1}, "friction is finite and not negative; that of contact 0 is -0.1"),
        ({"friction": np.nan}, "friction is finite and not negative"),
        ({"friction": True}, "friction is one number or one for each contact, not True"),
        ({"friction": "rough"}, "friction is one number or one for each contact, not 'rough'"),
        ({"T": [[np.inf, 0, 0], [0, 0, 0]]}, "T holds a value that is not finite"),
        ({"restitution": 2}, "restitution"),
    ],
)
def test_errors_say_what_is_wrong(changes, message):
    arguments = {**BALL, "v": [1.0, -1.0, 0.0], "friction": 0.5, **changes}
    with pytest.raises(saltus.ModelError) as error:
        saltus.resolve_impact(**arguments)
    assert str(error.value).startswith(message)


def test_a_text_for_T_is_no_array():
    with pytest.raises(TypeError, match=r"T = 'x' \(str\), which is no array of numbers"):
        saltus.resolve_impact(**{**BALL, "T": "x"}, v=[1.0, -1.0, 0.0], friction=0.5)


def test_bodies_that_are_jammed_end_in_an_error():
    facing = {"M": np.eye(2), "N": [[0, 1], [0, -1]], "T": [[1, 0], [0, 0]] * 2}
    with pytest.raises(saltus.JammedError, match="does not end within 50 impulses"):
        saltus.resolve_impact(**facing, v=[1, -1], friction=0.1, max_impulses=50)
