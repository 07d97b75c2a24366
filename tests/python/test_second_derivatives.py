"""Second derivatives of smooth steps: against differences of their exact gradients."""

from __future__ import annotations

import numpy as np
import pytest
from test_step_derivatives_friction import difference
from test_step_derivatives_random import random_inertia

import saltus
from saltus import At, Mimic, ModelBuilder, Pose, State, Wrench

Array = np.ndarray
KINDS = ("revolute", "prismatic", "helical")


def random_tree(seed: int, forces: bool = True) -> saltus.Model:
    """Return five joints, a mimic one among them, with all forces that have second derivatives."""
    random = np.random.default_rng(seed)
    builder = ModelBuilder("tree").set_gravity(4 * random.normal(size=3))
    names = ["world"]
    for i in range(5):
        builder.add_link(f"link_{i}", random_inertia(random))
        kind = "revolute" if i == 4 else str(random.choice(KINDS))
        more = {"pitch": 0.1} if kind == "helical" else {}
        if i == 4:
            more["mimic"] = Mimic("joint_0", -0.8, 0.1)
        builder.add_joint(
            f"joint_{i}",
            kind,
            parent=str(random.choice(names[-3:])),
            child=f"link_{i}",
            X_PJ=Pose(0.4 * random.normal(size=3)),
            axis=random.normal(size=3),
            damping=random.uniform(0, 0.3) if forces else 0.0,
            **more,
        )
        names.append(f"link_{i}")
    if forces:
        builder.add_position_servo("servo", joint="joint_1", kp=20, kd=2)
        builder.add_motor("motor", joint="joint_2").set_armature("joint_2", 0.2)
        builder.add_joint_spring("joint_3", curve=([-4.0, -1.0, 1.0, 4.0], [-3.0, -2.0, 1.0, 9.0]))
        builder.add_spring(
            "tie", a=At("link_3", (0.1, 0.2, 0)), b="world", stiffness=30, length=0.2
        )
        builder.add_spring("soft", a="link_4", b=At("link_1", (0, 0, 0.1)), stiffness=9.0)
        builder.set_gravity_compensation("link_2", 0.6)
    return builder.build()


class Sample:
    """A step, its inputs as one vector, and a covector of its end."""

    def __init__(self, model: saltus.Model, seed: int, h: float = 0.02) -> None:
        random = np.random.default_rng(1000 + seed)
        self.model, self.n, self.h = model, model.n_v, h
        self.m = len(model.control_names)
        start = model.state(model.random_configuration(seed), 2 * random.normal(size=self.n))
        self.x = np.concatenate([start.q, start.p, random.normal(size=self.m), [h]])
        self.hats = random.normal(size=(2, self.n))
        self.d = random.normal(size=len(self.x))
        self.d[-1] *= 0.1

    def step(self, x: Array) -> saltus.Stepper:
        """Return a stepper that has made the step."""
        q, p, u = x[: self.n], x[self.n : 2 * self.n], x[2 * self.n : -1]
        stepper = saltus.Stepper(self.model, h=x[-1], record=True)
        stepper.advance(State(0.0, q, p), control=u)
        return stepper

    def gradient(self, x: Array) -> Array:
        g = self.step(x).vjp(*self.hats)
        return np.concatenate([g.q, g.p, g.control, [g.h]])

    def product(self) -> Array:
        n, d = self.n, self.d
        out = self.step(self.x).hvp(
            *self.hats, d[:n], d[n : 2 * n], d[2 * n : -1] if self.m else None, dh=d[-1]
        )
        return np.concatenate([out.q, out.p, out.control, [out.h]])


@pytest.mark.parametrize("forces", [False, True], ids=["free", "driven"])
@pytest.mark.parametrize("seed", range(12))
def test_products_with_the_hessian(seed, forces):
    sample = Sample(random_tree(seed, forces), seed)
    exact = sample.product()
    expected = difference(lambda x: sample.gradient(sample.x + x * sample.d), 2e-3)
    # of eighth order; arcs are solved to 1e-12, over 2e-3
    assert np.abs(exact - expected).max() < 1e-8 * np.abs(expected).max()
    H = sample.step(sample.x).hessian(*sample.hats)
    np.testing.assert_array_equal(H, H.T)
    assert np.abs(H @ sample.d - exact).max() < 1e-13 * np.abs(H).max()  # rounding of sums


@pytest.mark.parametrize("seed", range(5))
def test_products_are_symmetric(seed):
    """Before its two halves are made one: c.(H d) = d.(H c), to rounding."""
    sample = Sample(random_tree(seed), seed)
    c, d = np.random.default_rng(seed).normal(size=(2, len(sample.d)))
    c[-1] *= 0.1
    d[-1] *= 0.1
    products = []
    for direction in (c, d):
        sample.d = direction
        products.append(sample.product())
    size = np.linalg.norm(c) * np.linalg.norm(products[1])
    assert abs(c @ products[1] - d @ products[0]) < 1e-13 * size


def test_products_by_forces_on_coordinates():
    model = saltus.read_urdf(saltus.scenes.chain(3)).build()
    start = model.state([0.5, -0.4, 0.3], [1.0, -2.0, 0.5])
    qfrc, by_q, by_p, d = np.random.default_rng(2).normal(size=(4, 3))

    def made(x: float) -> saltus.Stepper:
        stepper = saltus.Stepper(model, h=0.02, record=True)
        stepper.advance(start, qfrc=qfrc + x * d)
        return stepper

    exact = made(0).hvp(by_q, by_p, dqfrc=d)
    for name in ("q", "p", "qfrc"):
        expected = difference(lambda x, n=name: getattr(made(x).vjp(by_q, by_p), n), 1e-2)
        np.testing.assert_allclose(getattr(exact, name), expected, atol=1e-11)


def test_far_from_the_origin_all_digits_stay():
    """A double pendulum a thousand kilometres away has the Hessian that it has here."""

    def made(x: float) -> Array:
        builder = ModelBuilder()
        for name, parent, at in (("a", "world", (x, 0, 0)), ("b", "a", (0, 0, -1))):
            builder.add_link(name, saltus.BodyInertia(1, (0, 0, -0.5), 0.1 * np.eye(3)))
            X = Pose(at)
            builder.add_joint(name, "revolute", parent=parent, child=name, X_PJ=X, axis=(0, 1, 0))
        sample = Sample(builder.build(), 3)
        return sample.step(sample.x).hessian(*sample.hats)

    np.testing.assert_array_equal(made(1e6), made(0))


def test_what_has_none_is_named():
    def refused(model: saltus.Model, words: str, **applied: object) -> None:
        stepper = saltus.Stepper(model, record=True)
        stepper.advance(model.state(), **applied)
        with pytest.raises(saltus.ModelError, match=words):
            stepper.hessian(np.ones(model.n_v), np.ones(model.n_v))

    sphere = {"shape": saltus.Sphere(0.1), "mass": 1.0}
    free = ModelBuilder().add_body("ball", **sphere, joint="floating").build()
    refused(free, "no second derivative yet: it has a ball or free joint")
    cart = ModelBuilder().add_body("cart", **sphere, joint="prismatic", axis=(0, 0, 1))
    refused(cart.build(), "it has forces on links", forces={"cart": Wrench((1, 0, 0))})
    floor = cart.add_half_space("floor", (0, 0, 1), -0.1)
    held = floor.set_default_contact(restitution=0, friction=0).build()
    refused(held, "it has contacts, loops or dry friction that hold or push")
    stepper = saltus.Stepper(held, h=0.05, record=True)
    stepper.advance(held.state([0.1], [-3.0]))
    with pytest.raises(saltus.ModelError, match="it has an impact, or more than one arc"):
        stepper.hvp([1.0], [0.0], dq=[1.0])
