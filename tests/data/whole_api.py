"""Uses every public name once, with types that mypy --strict accepts; prints "done"."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import numpy.typing as npt

import saltus

Array = npt.NDArray[np.float64]


def arm() -> saltus.ModelBuilder:
    """Return an arm of two rods with what joints, links and the builder know."""
    rod: saltus.Shape = saltus.Capsule(0.03, 0.2)
    inertia: saltus.BodyInertia = saltus.solid_inertia(1.0, rod)
    builder = saltus.ModelBuilder("arm")
    builder.add_link("upper", inertia, check=saltus.InertiaCheck.strict).add_shape("upper", rod)
    builder.add_link("lower", saltus.solid_cylinder(1.0, 0.03, 0.2)).add_shape("lower", rod)
    turns = saltus.rotation_from_rpy(0.0, 0.0, 0.0)
    at = saltus.Pose((0.0, 0.0, 1.0), turns)
    revolute = saltus.JointType.revolute
    builder.add_joint("shoulder", revolute, parent="world", child="upper", X_PJ=at, axis=(0, 1, 0))
    at = saltus.Pose((0, 0, 0.5))
    builder.add_joint("elbow", revolute, parent="upper", child="lower", X_PJ=at, axis=(0, 1, 0))
    builder.add_link("pointer", saltus.solid_sphere(0.1, 0.02))
    builder.add_joint(
        "pointer", revolute, parent="world", child="pointer", mimic=saltus.Mimic("shoulder", 0.5)
    )
    builder.set_adjacent_links(saltus.AdjacentLinks.excluded)
    builder.set_solver(saltus.TreeSolver.automatic)
    builder.set_effects(saltus.JointEffects.all)
    builder.add_motor("motor", joint="elbow", effort=5.0)
    builder.add_sensor("tip", saltus.SensorKind.framepos, link="lower")
    mesh = saltus.TriangleMesh([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)], [(0, 1, 2)])
    builder.add_visual("lower", mesh, rgba=(1, 0, 0, 1))
    wall = saltus.At("world", (0.3, 0, 0.3))
    builder.add_spring("spring", a=saltus.At("upper"), b=wall, stiffness=2.0)
    link: saltus.BuilderLink = builder.link("upper")
    joint: saltus.BuilderJoint = builder.joint("shoulder")
    assert (link.name, joint.name) == ("upper", "shoulder")
    return builder


def look_at(model: saltus.Model) -> None:
    """Read what a model is made of, and what it does in one configuration."""
    links: list[saltus.Link] = model.links
    joints: list[saltus.JointInfo] = model.joints
    coordinates: list[saltus.Coordinate] = model.coordinates
    shapes: list[saltus.PlacedShape] = model.shapes
    pairs: list[saltus.Pair] = list(model.pairs)
    visuals: list[saltus.Visual] = model.visuals
    sensors: list[saltus.Sensor] = model.sensors
    solutions: list[saltus.TreeSolution] = model.solvers
    assert all((links, joints, coordinates, shapes, visuals, sensors, solutions))
    assert len(pairs) == model.n_pairs
    frames: saltus.Frames = model.at(model.neutral())
    partials: saltus.LagrangianPartials = model.lagrangian(model.neutral(), np.zeros(model.n_v))
    partials = model.lagrangian(model.neutral(), np.zeros(model.n_v), out=partials)
    gaps: saltus.Gaps = model.gaps(None)
    state: saltus.State = model.state()
    energy: saltus.Energies = saltus.energies(model, state, 0.01)
    assert frames.mass_matrix().shape == partials.L_vv.shape
    assert len(gaps) == model.n_pairs
    assert energy.kinetic == 0.0
    assert "shoulder" in saltus.model_tree(model)
    assert isinstance(saltus.equilibrium(model, keep=["shoulder", "elbow"]), saltus.State)


def shapes_and_gaps() -> None:
    """Measure distances, volumes and inertias of shapes."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    all_: list[saltus.Shape] = [
        saltus.Sphere(0.1),
        saltus.Box((0.1, 0.2, 0.3)),
        saltus.Cylinder(0.1, 0.2),
        saltus.Ellipsoid((0.1, 0.2, 0.3)),
        saltus.Convex(corners),
    ]
    floor = saltus.HalfSpace()
    up = saltus.Pose((0, 0, 2.0))
    for shape in all_:
        found: saltus.Gap = saltus.gap(shape, up, floor, saltus.Pose())
        assert saltus.has_gap(shape, floor)
        assert found.phi > 0 < saltus.volume(shape)
        assert saltus.shape_name(shape) in {name for pair in saltus.gap_table() for name in pair}
    assert saltus.solid_box(1.0, (0.1, 0.1, 0.1)).mass == 1.0


def policy(now: saltus.Moment) -> list[float]:
    """Return the control of a moment."""
    return [-float(now.v[1])]


def wind(now: saltus.ForceMoment) -> Array:
    """Return a force that slows all coordinates down."""
    return -0.1 * now.v


def own_law(impact: saltus.ImpactProblem) -> Array:
    """Return the momenta after an impact that loses all of the approach."""
    solution = saltus.resolve_impact(impact.M, impact.N, impact.v, restitution=0.0)
    momenta: Array = impact.M @ solution.v
    return momenta


def runs(folder: Path) -> None:
    """Make runs, save them, read them, look at their impacts."""
    cradle = saltus.load_urdf(
        saltus.urdf_dir() / "newtons_cradle_3.urdf",
        meshes=saltus.MeshUse.hull,
        inertia=saltus.InertiaUse.checked,
        contact=saltus.ContactProperties(restitution=1.0, friction=0.0),
    )
    run: saltus.Trajectory = saltus.simulate(cradle, {"swing_0": 0.3}, duration=0.6, certify=True)
    run.save(folder / "run.h5")
    again = saltus.load(folder / "run.h5")
    hit: saltus.Impact = again.impact(0)
    assert "ball_0" in saltus.impact_table(hit)
    batch: saltus.BatchTrajectory = saltus.simulate_batch(
        cradle, {"swing_0": [0.1, 0.2]}, duration=0.1, on_failure=saltus.OnFailure.stop
    )
    assert len(batch) == 2
    stepper = saltus.Stepper(cradle, 0.01, saltus.ImpactLaw.nodal_energy)
    options: saltus.StepOptions = stepper.options
    stepper.advance(cradle.state())
    report: saltus.StepReport = stepper.report
    contacts: list[saltus.ContactImpulse] = report.contacts
    assert options.h == 0.01
    assert isinstance(contacts, list)
    saltus.simulate(cradle, {"swing_0": 0.3}, duration=0.6, law=own_law)
    scene = saltus.load_urdf(saltus.scenes.cradle(2))
    apart = saltus.resolve_overlap(scene, {"swing_0": -0.01})
    assert apart.shape == (scene.n_q,)


def impacts() -> None:
    """Resolve impacts of matrices."""
    M, N, v = np.eye(3), np.array([[-1.0, 1, 0], [0, -1, 1]]), [1.0, 0, 0]
    certificate: saltus.ImpactCertificate = saltus.classify_impact(M, N)
    assert certificate.kind is saltus.ImpactKind.unique
    one = saltus.resolve_impact(M, N, v, order=saltus.ImpactOrder.index)
    assert isinstance(one, saltus.ImpactOutcome)
    every: saltus.ImpactOutcomes = saltus.impact_outcomes(M, N, v)
    np.testing.assert_allclose(every.outcomes[0].v, one.v, atol=1e-12)
    T = np.zeros((4, 3))
    rough = saltus.resolve_impact(M, N, v, T=T, friction=0.5)
    assert isinstance(rough, saltus.FrictionOutcome)


def errors(model: saltus.Model) -> None:
    """Meet errors and warnings by their classes."""
    assert issubclass(saltus.JammedError, saltus.StepError)
    assert issubclass(saltus.StepWarning, Warning)
    try:
        model.link("nobody")
    except saltus.ModelError as error:
        assert "nobody" in str(error)  # noqa: PT017  # a program, no test
    with warnings.catch_warnings():
        warnings.simplefilter("error", saltus.ModelWarning)
        saltus.read_urdf(saltus.urdf_dir() / "arm.urdf")


def loops() -> None:
    """Close a loop, and let it move under a force of one's own."""
    builder = arm().add_force("wind", wind)
    rail = saltus.At("world", (0, 0, 1.3))
    builder.add_loop("rail", saltus.LoopType.on_plane, a=saltus.At("lower"), b=rail)
    model = builder.build()
    saltus.check_derivatives(damped, model)
    closed = saltus.close_loops(model, {"shoulder": 1.0, "elbow": 1.0})
    assert closed.q.shape == (model.n_q,)


def damped(now: saltus.ForceMoment) -> tuple[Array, Array, Array]:
    """Return a force with its slopes by q and v."""
    n = len(now.v)
    return -0.1 * now.v, np.zeros((n, n)), -0.1 * np.eye(n)


def derivatives() -> None:
    """Look at a step's derivatives, and at feedback about an equilibrium."""
    builder = saltus.ModelBuilder().add_body("bob", saltus.Sphere(0.1), mass=1, joint="prismatic",
                                             joint_name="z", axis=(0, 0, 1))  # fmt: skip
    model = builder.build()
    stepper = saltus.Stepper(model, h=0.01, record=True)
    stepper.advance(model.state())
    whole: saltus.StepDerivative = stepper.derivative()
    bent: saltus.StepDirection = stepper.hvp([1.0], [0.0], dp=[1.0])
    assert stepper.hessian([1.0], [0.0])[0, 1] == bent.q[0]
    covector: saltus.StepDirection = stepper.vjp([1.0], [0.0])
    by_model: saltus.ModelGradient = stepper.model_gradient([1.0], [0.0])
    orders: list[saltus.Selection] = stepper.selections()
    impacts: list[saltus.ImpactDerivative] = list(whole.impacts)
    assert whole.smoothness == saltus.Smoothness.smooth
    assert covector.q.shape == by_model.damping.shape == (1,)
    assert whole.rubbing == []
    assert whole.torques.shape == (2, 0)
    assert covector.torques.shape == (0, 3)
    assert covector.friction.shape == (0,)
    assert by_model.friction == {}
    assert orders == []
    assert impacts == []
    run = saltus.simulate(model, duration=0.02)
    gradient: saltus.RunGradient = run.gradient([1.0], [0.0])
    assert gradient.q.shape == (1,)
    assert gradient.restitution == gradient.friction == {}
    assert all(place.shape == (3,) for place in gradient.placements.values())
    assert gradient.torques == {}
    assert saltus.optimize.Quadratic is not None
    falls = saltus.optimize.orbit(model, model.state(), 3, progress=False)
    assert not falls.converged
    assert falls.monodromy.shape == (2, 2)
    assert callable(saltus.optimize.transcribe)
    assert callable(saltus.autodiff.jax_rollout)
    assert callable(saltus.autodiff.torch_rollout)


def main() -> None:
    """Use all of it."""
    derivatives()
    model = arm().build()
    look_at(model)
    shapes_and_gaps()
    push = {"lower": saltus.Wrench((0.0, 0.0, 1.0))}
    run = saltus.simulate(model, {"shoulder": 0.3}, duration=0.1, control=policy, forces=push)
    assert run.sensor("tip").shape == (11, 3)
    runs(Path())
    impacts()
    errors(model)
    loops()
    assert saltus.cmake_dir().exists()
    assert saltus.__version__
    print("done")


if __name__ == "__main__":
    main()
