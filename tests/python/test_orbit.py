"""Orbits: against closed forms, through landing and take-off, differences, and what goes wrong."""

from __future__ import annotations

import _thread
import runpy

import numpy as np
import pytest
from tests.conftest import ROOT
from tests.python.driven_models import acrobot, bouncer, cart, spinner

import saltus
from saltus import ModelError, Smoothness, optimize
from saltus.optimize.orbits import Return
from saltus.optimize.system import System


@pytest.fixture(scope="module")
def hopper():
    """Return the gait of the example of a hopper."""
    return runpy.run_path(str(ROOT / "examples" / "hopper.py"))["gait"]


def test_a_forced_oscillator_has_a_closed_form():
    # m dv/dt = u - k q - c v by the midpoint rule
    m, k, c, h, N = 2.0, 8.0, 0.6, 0.05, 30
    model = cart().builder().add_joint_spring("cart", stiffness=k).set_damping("cart", c).build()
    u = np.sin(2 * np.pi * np.arange(N) / N)
    found = optimize.orbit(model, model.state(), u, h=h)
    assert found.converged
    assert len(found.misses) == 2  # it is linear
    K = np.array([[0, 1 / m], [-k, -c / m]])
    left, right = np.eye(2) - h / 2 * K, np.eye(2) + h / 2 * K
    A, b = np.linalg.solve(left, right), np.linalg.solve(left, [0, h])
    end = sum(np.linalg.matrix_power(A, N - 1 - i) @ b * u[i] for i in range(N))
    start = np.linalg.solve(np.eye(2) - np.linalg.matrix_power(A, N), end)
    # 30 steps, of rounding 1e-16 each
    assert np.concatenate([found.start.q, found.start.p]) == pytest.approx(start, abs=1e-13)
    np.testing.assert_allclose(found.monodromy, np.linalg.matrix_power(A, N), atol=1e-13)
    expected = np.linalg.eigvals(A) ** N
    assert sorted(found.multipliers, key=np.imag) == pytest.approx(
        sorted(expected, key=np.imag), abs=1e-13
    )
    assert np.abs(found.run(3).q[::N] - start[0]).max() < 1e-12


def test_a_bouncing_ball_has_a_family_of_orbits():
    # elastic, it flies as high as g T^2 / 8; where on its way the period begins is free
    g, h, N = 9.81, 0.01, 50
    model = bouncer().builder().set_default_contact(restitution=1.0).build()
    gap = 0.2
    found = optimize.orbit(model, model.state(v=[0.3]), N, h=h)
    assert found.converged
    top = gap + found.start.q[0] + model.velocity(found.start)[0] ** 2 / (2 * g)
    assert top == pytest.approx(g * (N * h) ** 2 / 8, abs=1e-10)
    # symplectic, and moved along itself it is an orbit still: both are 1. A double eigenvalue
    # moves with the square root of rounding.
    assert found.multipliers == pytest.approx([1, 1], abs=1e-6)
    assert np.linalg.det(found.monodromy) == pytest.approx(1, abs=1e-11)


def test_a_hopper_closes_its_gait(hopper):
    assert hopper.converged
    assert hopper.miss <= 1e-10
    assert hopper.misses[2] < hopper.misses[1] ** 1.5 < hopper.misses[0] ** 2  # quadratic
    run, model = hopper.run(5), hopper._system.model
    assert len(run.impacts) == 5  # the landings
    assert len(run.fallbacks) == 0
    assert set(hopper.smoothness) == {Smoothness.smooth}
    N, x = len(hopper.control), model.velocity_index("x")
    at = run.q[::N].copy()
    at[:, x] -= np.arange(6) * hopper.travel[x]
    assert np.abs(at - at[0]).max() < 1e-10
    assert np.abs(run.p[::N] - run.p[0]).max() < 1e-9
    assert hopper.travel[x] > 0.1
    assert np.all(np.delete(hopper.travel, x) < 1e-10)


def test_a_stride_balances_weight_and_friction(hopper):
    stride = hopper.run(record_contacts=True)
    model, T = hopper._system.model, stride.t[-1]
    lifted = sum(link.inertia.mass for link in model.links if link.name not in ("world", "slide"))
    contacts = stride.contacts
    assert contacts["lambda"].sum() / T == pytest.approx(lifted * 9.81, rel=1e-10)
    assert abs(contacts["tangential"].sum(axis=0)[0]) < 1e-10 * contacts["lambda"].sum()


def test_multipliers_of_the_hopper_are_those_of_differences(hopper):
    system, start = hopper._system, hopper.start
    n, e = 2 * system.model.n_v, 1e-6
    columns = []
    for dx in e * np.eye(n):
        ends = [system.roll(system.shift(start, d), hopper.control).states[-1] for d in (-dx, dx)]
        columns.append(system.difference(*ends) / (2 * e))
    M = np.stack(columns, axis=1)
    # central differences: e^2 of truncation times third derivatives, 1e-16 / e of rounding
    assert np.abs(M - hopper.monodromy).max() < 1e-7 * np.abs(M).max()
    kept = np.delete(np.arange(n), system.model.velocity_index("x"))
    own, theirs = hopper.multipliers, np.linalg.eigvals(M[np.ix_(kept, kept)])
    assert len(own) == n - 1
    # what the landing forgets has multiplier 0: the foot's place and speed
    for each in own[:4]:
        assert np.abs(theirs - each).min() < 1e-7
    assert np.abs(own[4:]).max() < 1e-7
    assert np.abs(own).max() < 1
    assert list(np.abs(own)) == sorted(np.abs(own), reverse=True)


def test_deviations_from_the_gait_die_out_as_the_multipliers_tell(hopper):
    system = hopper._system
    d = np.zeros(2 * system.model.n_v)
    d[system.model.velocity_index("z")] = 1e-3
    x = system.shift(hopper.start, d)
    sizes = []
    for _ in range(8):
        x = system.roll(x, hopper.control).states[-1]
        moved = system.difference(hopper.start, x)
        sizes.append(np.linalg.norm(np.delete(moved, system.model.velocity_index("x"))))
    rate = (sizes[7] / sizes[3]) ** (1 / 4)
    assert rate == pytest.approx(abs(hopper.multipliers[0]), rel=0.3)  # a spiral: it swings


def test_an_orbit_that_repels_is_found_too():
    model, h, N = acrobot(), 0.02, 20
    up = model.state(q=[np.pi, 0.0])
    found = optimize.orbit(model, model.state(q=[np.pi + 0.05, -0.03]), N, h=h)
    assert found.converged
    assert np.abs(found.start.q - up.q).max() < 1e-9
    assert abs(found.multipliers[0]) > 3
    assert abs(np.prod(found.multipliers)) == pytest.approx(1, abs=1e-9)  # symplectic
    assert "largest multiplier" in repr(found)


def test_jacobian_of_balls_against_differences():
    model, rng, N = spinner(), np.random.default_rng(5), 12
    start = model.state(v=rng.normal(size=model.n_v))
    m = 2 * model.n_v
    back = Return(System(model, 0.02, {}), start, rng.normal(size=(N, 1)), np.arange(m))
    J = back.jacobian(back.path(np.zeros(m)))[0]
    e = 1e-5 * np.eye(m)
    by = [back.misses(back.path(d))[0] - back.misses(back.path(-d))[0] for d in e]
    assert np.abs(back.misses(back.path(np.zeros(m)))[0]).max() > 0.1  # far from closed
    assert np.allclose(J, np.array(by).T / 2e-5, atol=1e-7 * np.abs(J).max())


def test_ctrl_c_keeps_the_best_so_far(capsys):
    model = bouncer()

    def stop(part: float) -> None:
        _thread.interrupt_main()

    u = np.where(np.arange(50) < 25, 12.0, 0.0)
    found = optimize.orbit(model, model.state(), u, progress=stop)
    assert found.message == "stopped after 1 iterations"
    assert found.misses[1] < found.misses[0]
    assert "best so far" in capsys.readouterr().err


def test_orbit_says_what_is_wrong():
    model = bouncer()
    start = model.state()
    with pytest.raises(ModelError, match="bal"):
        optimize.orbit(model, start, 5, free=["bal"])
    with pytest.raises(ModelError, match="ball_qx is a part of a quaternion"):
        optimize.orbit(spinner(), spinner().state(), 5, free=["ball_qx"])
    with pytest.raises(ModelError, match="ball is free, but the motion depends on it: in a period"):
        optimize.orbit(model, start, 40, free=["ball"])
    with pytest.raises(ModelError, match="controls is 0"):
        optimize.orbit(model, start, 0)
    with pytest.raises(ModelError, match="settle is -1"):
        optimize.orbit(model, start, 5, settle=-1)
    with pytest.raises(ModelError, match="iterations is 0"):
        optimize.orbit(model, start, 5, iterations=0)
    with pytest.raises(TypeError, match="start is a list"):
        optimize.orbit(model, [0.0], 5)
    still = saltus.ModelBuilder().set_gravity((0, 0, 0))
    still.add_body("puck", saltus.Sphere(0.1), mass=1.0, joint="prismatic")
    model = still.build()
    found = optimize.orbit(model, model.state(v=[0.1]), 5, free=["puck"])
    assert found.travel == pytest.approx([0.1 * 0.05])
    with pytest.raises(ModelError, match="periods is 0"):
        found.run(0)
