"""Derivatives where torques act, and forces in a body's axes: differences of whole steps."""

from __future__ import annotations

import numpy as np
import pytest
from test_gradients_by_placements import driven_tree
from test_step_derivatives_friction import difference

import saltus
from saltus import ModelBuilder, State, Wrench

Array = np.ndarray
FRAMES = ("world", "body")


class Pushed:
    """A step with wrenches on two links, and directions of all that it is made from."""

    def __init__(self, model: saltus.Model, links: tuple[str, str], start: State, h: float) -> None:
        self.model, self.links, self.start, self.h = model, links, start, h
        random = np.random.default_rng(8)
        n = model.n_v
        self.force, self.torque, self.point = 4 * random.normal(size=(3, 2, 3))
        self.d_force, self.d_torque = random.normal(size=(2, 2, 3))
        self.dq, self.dp, self.by_q, self.by_p = random.normal(size=(4, n))
        self.dh = 0.1 * random.normal()

    def wrenches(self, x: float) -> dict[str, Wrench]:
        """Return one in the axes of the world and one in those of its body."""
        force, torque = self.force + x * self.d_force, self.torque + x * self.d_torque
        return {
            link: Wrench(force[k], torque[k], point=0.1 * self.point[k], frame=FRAMES[k])
            for k, link in enumerate(self.links)
        }

    def step(self, x: float, **options: bool) -> tuple[saltus.Stepper, State]:
        q = self.model.integrate(self.start.q, x * self.dq)
        stepper = saltus.Stepper(self.model, h=self.h + x * self.dh, **options)
        start = State(0.0, q, self.start.p + x * self.dp)
        return stepper, stepper.advance(start, forces=self.wrenches(x))

    def errors(self, by: float) -> tuple[float, float]:
        """Return how far jvp is from differences, and vjp from jvp."""
        stepper, end = self.step(0.0, record=True)
        forwards = np.concatenate(
            stepper.jvp(self.dq, self.dp, dh=self.dh, dforces=self.d_force, dtorques=self.d_torque)
        )
        back = stepper.vjp(self.by_q, self.by_p)
        found = back.q @ self.dq + back.p @ self.dp + back.h * self.dh
        found += np.sum(back.forces * self.d_force) + np.sum(back.torques * self.d_torque)
        covector = np.concatenate([self.by_q, self.by_p])
        d = stepper.derivative()
        whole = d.A @ np.concatenate([self.dq, self.dp]) + d.h * self.dh
        whole += d.forces @ self.d_force.ravel() + d.torques @ self.d_torque.ravel()
        np.testing.assert_allclose(whole, forwards, atol=1e-12 * np.abs(forwards).max())

        def moved(x: float) -> Array:
            after = self.step(x)[1]
            return np.concatenate([self.model.difference(end.q, after.q), after.p])

        expected = difference(moved, by)
        size = np.linalg.norm(covector) * np.linalg.norm(forwards)
        wrong = np.abs(forwards - expected).max() / np.abs(expected).max()
        return float(wrong), float(abs(covector @ forwards - found) / size)


@pytest.mark.parametrize("links", [("follower", "base"), ("screw", "elbow"), ("shoulder", "pole")])
@pytest.mark.parametrize("seed", range(3))
def test_a_step_of_joints_of_all_kinds(links, seed):
    model = driven_tree({})
    random = np.random.default_rng(seed)
    start = model.state(model.random_configuration(seed), 2 * random.normal(size=model.n_v))
    # dampers between points have slopes that differences of 1e-3 see to 1e-10
    wrong, transposed = Pushed(model, links, start, 0.01).errors(1e-3)
    assert wrong < 1e-9
    assert transposed < 1e-14  # rounding


def test_an_impact_of_a_body_that_is_turned():
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    for name in ("box", "other"):
        builder.add_body(name, saltus.Box((0.1, 0.2, 0.1)), mass=1.0, joint="floating")
    model = builder.set_default_contact(restitution=0.5, friction=0.2).build()
    q = model.normalized([0, 0, 0.27, 0.3, 0.2, 0.1, 0.9, 2, 0, 5.0, 0.1, 0.2, 0.3, 0.8])
    start = model.state(q, [1.0, 0.5, -4.0, 1.0, -2.0, 0.5, 0, 0, 0, 3, 1, -2])
    pushed = Pushed(model, ("other", "box"), start, 0.02)
    assert len(pushed.step(0.0)[0].report.impacts) == 1
    wrong, transposed = pushed.errors(1e-4)
    assert wrong < 1e-8  # of an impact by differences of 1e-4
    assert transposed < 1e-13


def test_a_run_by_the_torque_of_a_wrench():
    """A top that is driven about its own axis: by the torque, in each step and in all."""
    builder = ModelBuilder().add_link("top", saltus.BodyInertia(1, (0, 0, 0.3), 0.02 * np.eye(3)))
    builder.add_joint("tip", "spherical", parent="world", child="top")
    model = builder.build()
    start = model.state(v=[0.2, 0.1, 20.0])
    torque = np.array([0.1, 0.0, 0.4])

    def run(x: Array) -> tuple[saltus.Trajectory, dict[str, Wrench]]:
        forces = {"top": Wrench(torque=torque + x, frame="body")}
        arguments = {"duration": 0.3, "h": 0.01, "forces": forces, "progress": False}
        return saltus.simulate(model, state=start, **arguments), forces

    made, forces = run(np.zeros(3))
    by_p = np.array([1.0, -0.5, 0.8])
    by_torque = made.gradient(np.zeros(3), by_p, forces=forces).torques["top"]
    assert by_torque.shape == (30, 3)
    for axis in np.eye(3):
        expected = difference(lambda x, e=axis: float(by_p @ run(x * e)[0].p[-1]), 1e-3)
        assert by_torque.sum(axis=0) @ axis == pytest.approx(expected, rel=1e-8, abs=1e-10)
