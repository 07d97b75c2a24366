"""Derivatives of steps of random scenes: against differences of the whole step, and transposed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import saltus
from saltus import BodyInertia, ModelBuilder, Pose, Smoothness, State

KINDS = ("revolute", "prismatic", "spherical", "floating", "helical")


def difference(f: Callable[[float], np.ndarray], h: float) -> np.ndarray:
    """Return f'(0) by central differences of eighth order."""
    weights = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
    return sum(w * (f(k * h) - f(-k * h)) for k, w in enumerate(weights, 1)) / h


def random_inertia(random: np.random.Generator) -> BodyInertia:
    """Return the inertia of a cloud of points."""
    points = random.normal(size=(10, 3)) * 0.3
    second = points.T @ points / 10
    about = np.trace(second) * np.eye(3) - second
    mass = random.uniform(0.5, 2)
    return BodyInertia(mass, random.normal(size=3) * 0.2, mass * about)


def random_tree(seed: int, forces: bool) -> saltus.Model:
    """Return up to five joints of all kinds, with damping, servos and springs if asked for."""
    random = np.random.default_rng(seed)
    builder = ModelBuilder("tree").set_gravity(random.normal(size=3) * 4)
    names = ["world"]
    for i in range(int(random.integers(1, 6))):
        builder.add_link(f"link_{i}", random_inertia(random))
        kind = str(random.choice(KINDS, p=(0.4, 0.2, 0.2, 0.1, 0.1)))
        joint, parent = f"joint_{i}", str(random.choice(names[-3:]))
        builder.add_joint(
            joint,
            kind,
            parent=parent,
            child=f"link_{i}",
            X_PJ=Pose(random.normal(size=3) * 0.4),
            axis=random.normal(size=3),
            pitch=0.1 if kind == "helical" else 0.0,
            damping=random.uniform(0, 0.3) if forces else 0.0,
        )
        names.append(f"link_{i}")
        if forces and kind in ("revolute", "prismatic"):
            builder.add_position_servo(f"servo_{i}", joint=joint, kp=20, kd=2)
            builder.add_motor(f"motor_{i}", joint=joint)
            builder.set_armature(joint, 0.2)
            builder.add_joint_spring(joint, stiffness=5.0)
    if forces and len(names) > 2:
        builder.add_spring("spring", a=names[1], b=names[2], stiffness=3.0, length=0.1)
    return builder.build()


def omega(model: saltus.Model, p: np.ndarray) -> np.ndarray:
    """Return the symplectic form in trivialised directions: [[-[p]x, -1], [1, 0]]."""
    n = model.n_v
    turned = np.zeros((n, n))
    for joint in model.joints:
        if joint.type not in (saltus.JointType.spherical, saltus.JointType.floating):
            continue
        k = joint.velocities[-3:]
        x, y, z = p[k]
        turned[np.ix_(k, k)] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    one = np.eye(n)
    return np.block([[-turned, -one], [one, np.zeros((n, n))]])


class Sample:
    """A step, a direction of all of its inputs, and a covector."""

    def __init__(self, stepper: saltus.Stepper, start: State, seed: int, forces: bool = True):
        random = np.random.default_rng(seed)
        self.stepper, self.model, self.start = stepper, stepper.model, start
        n, m = self.model.n_v, len(self.model.control_names)
        self.u = random.normal(size=m)
        self.qfrc = random.normal(size=n) if forces else np.zeros(n)
        self.dq, self.dp, self.dqfrc = random.normal(size=(3, n))
        self.du, self.dh = random.normal(size=m), 0.1 * random.normal()
        self.covector = random.normal(size=(2, n))
        self.end = stepper.advance(start, control=self.u, qfrc=self.qfrc)
        self.impacts = [impact.pairs for impact in stepper.report.impacts]

    def jvp(self) -> np.ndarray:
        out = self.stepper.jvp(self.dq, self.dp, self.du, dqfrc=self.dqfrc, dh=self.dh)
        return np.concatenate(out)

    def transposed_error(self) -> float:
        """Return |c.(D d) - (D^T c).d| over the size of both."""
        g = self.stepper.vjp(*self.covector)
        forwards = self.jvp()
        back = g.q @ self.dq + g.p @ self.dp + g.control @ self.du + g.qfrc @ self.dqfrc
        size = np.linalg.norm(self.covector) * np.linalg.norm(forwards)
        return abs(self.covector.ravel() @ forwards - back - g.h * self.dh) / size

    def moved(self, x: float) -> tuple[np.ndarray, list[list[str]]]:
        """Return where the step ends from a start moved by x, and its impacts."""
        model = self.model
        start = State(0.0, model.integrate(self.start.q, x * self.dq), self.start.p + x * self.dp)
        stepper = saltus.Stepper(model, h=self.stepper.options.h + x * self.dh)
        end = stepper.advance(start, control=self.u + x * self.du, qfrc=self.qfrc + x * self.dqfrc)
        rows = np.concatenate([model.difference(self.end.q, end.q), end.p])
        return rows, [impact.pairs for impact in stepper.report.impacts]


@pytest.mark.parametrize("seed", range(40))
def test_smooth_steps_of_driven_trees(seed):
    model = random_tree(seed, forces=True)
    random = np.random.default_rng(1000 + seed)
    start = model.state(model.random_configuration(seed), random.normal(size=model.n_v) * 2)
    sample = Sample(saltus.Stepper(model, h=0.02, record=True), start, seed)
    assert sample.transposed_error() < 1e-14  # rounding
    expected = difference(lambda x: sample.moved(x)[0], 2e-3)
    # truncation of eighth order and rounding, of trees that turn by some radians a step
    assert np.abs(sample.jvp() - expected).max() < 1e-8 * np.abs(expected).max()


@pytest.mark.parametrize("seed", range(40))
def test_free_steps_are_symplectic(seed):
    model = random_tree(seed, forces=False)
    random = np.random.default_rng(1000 + seed)
    start = model.state(model.random_configuration(seed), random.normal(size=model.n_v) * 2)
    stepper = saltus.Stepper(model, h=0.02, record=True)
    end = stepper.advance(start)
    A = stepper.derivative().A
    error = np.abs(A.T @ omega(model, end.p) @ A - omega(model, start.p)).max()
    # rounding: of momenta of 10 and inertias of .01, and of Newton's residual
    assert error < 1e-11 * max(1.0, np.abs(A).max() ** 2)


def thrown(seed: int) -> tuple[saltus.Model, State]:
    """Return bodies that fall at a floor and a wall, and arms with limits above it."""
    random = np.random.default_rng(seed)
    builder = ModelBuilder("thrown").add_half_space("floor", (0, 0, 1))
    builder.add_half_space("wall", (-1, 0, 0.3), -0.5)
    builder.set_default_contact(restitution=float(random.choice([0, 0.5, 0.8, 1])))
    shapes = (saltus.Sphere(0.1), saltus.Box((0.2, 0.3, 0.25)), saltus.Capsule(0.06, 0.3))
    for i in range(int(random.integers(1, 4))):
        kind = int(random.integers(0, 4))
        if kind < 3:
            builder.add_body(f"body_{i}", shapes[kind], mass=1.0, joint="floating")
            continue
        for k, (parent, at) in enumerate((("world", (0, 2 * i, 1)), (f"arm_{i}_0", (0, 0, -0.4)))):
            name = f"arm_{i}_{k}"
            builder.add_link(name, BodyInertia(1, (0, 0, -0.2), 0.02 * np.eye(3)))
            axis = (0, 1, 0.2 * k)
            builder.add_joint(
                f"joint_{i}_{k}",
                "revolute",
                parent=parent,
                child=name,
                X_PJ=Pose(at),
                axis=axis,
                damping=0.05,
                lower=-1,
                upper=1.2,
            )
        builder.add_shape(f"arm_{i}_1", saltus.Sphere(0.05), Pose((0, 0, -0.4)))
    model = builder.build()
    state = model.state(v=random.normal(size=model.n_v) * 2)
    q = np.array(state.q)
    for k, coordinate in enumerate(model.coordinates):
        name = coordinate.name
        if name.endswith("_z"):
            q[k] = random.uniform(0.35, 0.5)
        elif name.endswith("_x"):
            q[k] = random.normal() * 0.1 - 0.3
        elif name.endswith("_y"):
            q[k] = 2 * k
        elif name.startswith("joint"):
            q[k] = random.uniform(-0.5, 0.5)
    return model, State(0.0, saltus.resolve_overlap(model, q), state.p)


@pytest.mark.parametrize("seed", range(60))
def test_steps_through_impacts(seed):
    model, state = thrown(seed)
    stepper = saltus.Stepper(model, h=0.01, record=True)
    for k in range(50):
        sample = Sample(stepper, state, 100 * seed + k, forces=False)
        state = sample.end
        if not (stepper.report.impacts or stepper.report.sustained):
            continue
        d = stepper.derivative()
        assert sample.transposed_error() < 1e-13
        if d.smoothness != Smoothness.smooth or stepper.report.sustained:
            continue
        # far below the depth, where trajectories near by have the same impacts
        h = min([1e-4, *(0.01 * impact.depth for impact in d.impacts)])
        gaps = model.gaps(sample.start.q).phi
        if gaps.min() < 100 * h:  # a start that is moved might overlap
            continue
        if any(sample.moved(x)[1] != sample.impacts for x in (-4 * h, 4 * h)):
            continue
        expected = difference(lambda x, sample=sample: sample.moved(x)[0], h)
        assert np.abs(sample.jvp() - expected).max() < 1e-7 * np.abs(expected).max()


def test_the_gradient_of_a_run_is_that_of_its_end():
    """A pendulum that swings at a wall, by its start, its motor and its inertia."""

    def build(mass: float = 1.0, damping: float = 0.1) -> saltus.Model:
        builder = ModelBuilder().add_half_space("wall", (-1, 0, 0), -0.4)
        builder.add_link("bob", BodyInertia(mass, (0, 0, -1), mass * 0.001 * np.eye(3)))
        builder.add_shape("bob", saltus.Sphere(0.05), Pose((0, 0, -1)))
        builder.add_joint(
            "swing", "revolute", parent="world", child="bob", axis=(0, -1, 0), damping=damping
        )
        builder.set_default_contact(restitution=0.8)
        return builder.add_motor("motor", joint="swing").build()

    def run(q=0.2, p=1.0, u=0.3, **model: float) -> saltus.Trajectory:
        built = build(**model)
        v = p / float(built.mass_matrix([q])[0, 0])
        return saltus.simulate(built, [q], [v], duration=0.5, control=[u], progress=False)

    made = run()
    assert len(made.impacts) == 1
    g = made.gradient(q_hat=[1.0], p_hat=[0.5])

    def slope(name: str, at: float) -> float:
        def cost(x: float) -> float:
            end = run(**{name: at + x})
            return float(end.q[-1, 0] + 0.5 * end.p[-1, 0])

        return float(difference(cost, 1e-4))

    tolerance = {"rel": 1e-8}
    assert g.q[0] == pytest.approx(slope("q", 0.2), **tolerance)
    assert g.p[0] == pytest.approx(slope("p", 1.0), **tolerance)
    assert g.control.sum() == pytest.approx(slope("u", 0.3), **tolerance)
    assert g.damping[0] == pytest.approx(slope("damping", 0.1), **tolerance)
    bob = [link.name for link in made.model.links].index("bob")
    by_mass = g.inertia[bob] @ [1, 0, 0, -1, 1.001, 0, 0, 1.001, 0, 0.001]
    assert by_mass == pytest.approx(slope("mass", 1.0), **tolerance)
