"""Jacobians and dynamics of real robots against Pinocchio, by name; and their shapes in Python."""

from __future__ import annotations

import numpy as np
import pytest
import test_robots as robots

import saltus

pin = robots.pin
TOLERANCE = robots.TOLERANCE


def twins(name: str):
    twin = robots.Twin(name)
    for q, v, a in robots.random_configurations(name, 10):
        yield twin, q, v, a


def frame_jacobian(twin: robots.Twin, q: np.ndarray, link: str) -> np.ndarray:
    """Return Pinocchio's Jacobian of a link's origin, [angular; linear], by our velocities."""
    own = twin.configuration(q)
    frame = twin.theirs.getFrameId(link, pin.FrameType.BODY)
    pin.computeJointJacobians(twin.theirs, twin.data, own)
    pin.updateFramePlacements(twin.theirs, twin.data)
    kind = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    J = pin.getFrameJacobian(twin.theirs, twin.data, frame, kind) @ twin.C(q)
    return np.vstack([J[3:], J[:3]])


@robots.each_robot
def test_jacobians(name):
    for twin, q, _, _ in twins(name):
        frames = twin.ours.at(q)
        for link in twin.ours.link_names[1::3]:
            theirs = frame_jacobian(twin, q, link)
            # relative to the largest lever, of 1 m at least: that of a small hand is rounding
            most = max(1.0, np.abs(theirs).max())
            np.testing.assert_allclose(frames.jacobian(link), theirs, rtol=0, atol=TOLERANCE * most)
            placement = twin.data.oMf[twin.theirs.getFrameId(link, pin.FrameType.BODY)]
            np.testing.assert_allclose(frames.pose(link).p, placement.translation, atol=TOLERANCE)


@robots.each_robot
def test_inverse_dynamics(name):
    for twin, q, v, a in twins(name):
        ours, theirs = twin.ours.inverse_dynamics(q, v, a), twin.inverse_dynamics(q, v, a)
        M = twin.mass_matrix(q)
        bound = np.sqrt(M.diagonal()) * (np.sqrt(M.diagonal()) @ (np.abs(a) + np.abs(v) ** 2))
        robots.assert_close(name, ours, theirs, bound + twin.gravity_bound(M))


@robots.each_robot
def test_gravity_forces(name):
    for twin, q, _, _ in twins(name):
        bound = twin.gravity_bound(twin.mass_matrix(q))
        robots.assert_close(name, -twin.ours.gravity_forces(q), twin.gravity(q), bound)


@robots.each_robot
def test_accelerations(name):
    """Forward dynamics, judged by the forces it makes: M times its difference from Pinocchio's.

    Pinocchio's aba knows no mimic joints; there M of its crba is solved with.
    """
    for twin, q, v, a in twins(name):
        M = twin.mass_matrix(q)
        forces = twin.inverse_dynamics(q, v, a)
        difference = M @ (twin.ours.accelerations(q, v, forces) - a)
        bound = np.sqrt(M.diagonal()) * (np.sqrt(M.diagonal()) @ (np.abs(a) + np.abs(v) ** 2))
        robots.assert_close(name, difference, 0 * a, bound + twin.gravity_bound(M))


def test_accelerations_are_abas():
    """Of a fixed base without mimic joints v and a are Pinocchio's own."""
    twin = robots.Twin("ur5")
    for q, v, forces in robots.random_configurations("ur5", 10):
        C = twin.C(q)
        theirs = pin.aba(twin.theirs, twin.data, twin.configuration(q), C @ v, C @ forces)
        ours = C @ twin.ours.accelerations(q, v, forces)
        # 1e-10: the condition of M is 1e3 to 1e4, and both have rounding of their own
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-10 * np.abs(theirs).max())


@robots.each_robot
def test_centre_of_mass_and_momentum(name):
    for twin, q, v, _ in twins(name):
        own, C = twin.configuration(q), twin.C(q)
        theirs = pin.centerOfMass(twin.theirs, twin.data, own)
        com = twin.ours.centre_of_mass(q)
        np.testing.assert_allclose(com, theirs, rtol=0, atol=TOLERANCE * 2)  # robots of 2 m
        h = pin.computeCentroidalMomentum(twin.theirs, twin.data, own, C @ v)
        ours = twin.ours.momentum(q, v, about=com)
        most = twin.mass * (1 + np.abs(v).sum())  # levers of 1 m, at most n of them
        np.testing.assert_allclose(ours, [*h.angular, *h.linear], rtol=0, atol=TOLERANCE * most)


def test_panda_and_pinocchio_agree_on_the_hand():
    model = robots.load("panda")
    assert model.link("panda_hand").mass > 0
    with pytest.raises(saltus.ModelError, match="no link 'panda_fist'"):
        model.jacobian(None, "panda_fist")
