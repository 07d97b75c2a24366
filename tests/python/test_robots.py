"""Real robots from example-robot-data against Pinocchio, coordinate by coordinate, by name.

Tolerances are relative to what bounds each quantity: |M_ij| <= sqrt(M_ii M_jj), and a force of
gravity |G_i| <= g sqrt(m M_ii) (Cauchy-Schwarz, m the mass of the robot); the entries themselves
may cancel to any smallness.
"""

from __future__ import annotations

import functools
import warnings
import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np
import pytest
from robot_files import robots_folder

import saltus

NEEDED = "Pinocchio is not installed: pip install 'saltus[robots]'"
pin = pytest.importorskip("pinocchio", reason=NEEDED)
TOLERANCE = 1e-12


@dataclass(frozen=True)
class Robot:
    path: str
    n_v: int
    floating: bool = False
    warning: str = "mesh"  # some of what the file has and we do not use
    energy_band: float = 1e-8  # in a free motion of 1 s at h = 1 ms, see below
    srdf: str | None = None


ROBOTS = {
    # one finger mimics the other
    "panda": Robot(
        "panda_description/urdf/panda.urdf",
        8,
        energy_band=1e-4,
        srdf="panda_description/srdf/panda.srdf",
    ),
    "anymal": Robot(
        "anymal_b_simple_description/robots/anymal.urdf",
        12 + 6,
        floating=True,
        warning='link "base" has principal moments',
    ),
    "talos": Robot(
        "talos_data/robots/talos_reduced.urdf", 38, floating=True, srdf="talos_data/srdf/talos.srdf"
    ),
    "tiago": Robot("tiago_description/robots/tiago.urdf", 48),
    "ur5": Robot(
        "ur_description/urdf/ur5_robot.urdf",
        6,
        energy_band=1e-5,
        srdf="ur_description/srdf/ur5.srdf",
    ),
}


def load_anew(name: str, **options) -> saltus.Model:
    robot, kinds = ROBOTS[name], saltus.JointType
    folder = robots_folder()
    options.setdefault("effects", "none")  # as Pinocchio: limits and damping are information
    return saltus.load_urdf(
        folder / robot.path,
        package_dirs=[folder, folder.parent],
        root_joint=kinds.floating if robot.floating else kinds.fixed,
        **options,
    )


@functools.cache
def load(name: str) -> saltus.Model:
    with warnings.catch_warnings():  # test_loads is about them
        warnings.simplefilter("ignore", saltus.ModelWarning)
        return load_anew(name)


@functools.cache
def load_pinocchio(name: str):
    """Return Pinocchio's model, its floating base being the same chain of joints as ours."""
    robot = ROBOTS[name]
    path = str(robots_folder() / robot.path)
    if not robot.floating:
        return pin.buildModelFromUrdf(path)
    base = pin.JointModelComposite(pin.JointModelPX())
    for joint in (pin.JointModelPY, pin.JointModelPZ, pin.JointModelSpherical):
        base.addJoint(joint())
    return pin.buildModelFromUrdf(path, base, "root")


class Twin:
    """Pinocchio's view of one of our models: v_pin = C v, and q_pin likewise.

    Pinocchio is asked to leave mimic joints independent, so that C ties them, not its own code.
    The angular velocity of its free base is in the body's axes, ours in the world's: C turns it,
    and since R' w of w alone vanishes, accelerations by the same C.
    """

    def __init__(self, name: str) -> None:
        self.ours, self.theirs = load(name), load_pinocchio(name)
        self.data = self.theirs.createData()
        self.mass = sum(inertia.mass for inertia in self.theirs.inertias)
        self.constant = np.zeros((self.theirs.nv, self.ours.n_v))
        self.floating = ROBOTS[name].floating
        self.offset = np.zeros(self.theirs.nv)
        tree = ET.parse(robots_folder() / ROBOTS[name].path)
        mimics = {j.get("name"): j.find("mimic") for j in tree.iterfind("joint")}
        for name_of_joint in self.theirs.names[1:]:
            row = self.theirs.joints[self.theirs.getJointId(name_of_joint)].idx_v
            if name_of_joint == "root":
                self.constant[row : row + 6, :6] = np.eye(6)
                continue
            mimic = mimics[name_of_joint]
            driver = name_of_joint if mimic is None else mimic.get("joint")
            factor = 1.0 if mimic is None else float(mimic.get("multiplier", 1))
            self.offset[row] = 0.0 if mimic is None else float(mimic.get("offset", 0))
            self.constant[row, self.ours.velocity_index(driver)] = factor

    def C(self, q: np.ndarray) -> np.ndarray:
        out = self.constant.copy()
        if self.floating:
            out[3:6, 3:6] = saltus.Pose.from_quaternion(q[3:7]).R.T
        return out

    def configuration(self, q: np.ndarray) -> np.ndarray:
        """Return Pinocchio's q, which for continuous joints is (cos, sin)."""
        moved = self.ours.difference(self.ours.neutral(), q)
        angles, out = self.constant @ moved + self.offset, np.zeros(self.theirs.nq)
        for joint in self.theirs.joints[1:]:
            if joint.nq == 7:  # the free base: quaternions are x y z w in both
                out[joint.idx_q : joint.idx_q + 7] = q[:7]
            elif joint.nq == joint.nv:
                out[joint.idx_q : joint.idx_q + joint.nq] = angles[joint.idx_v :][: joint.nv]
            else:
                angle = angles[joint.idx_v]
                out[joint.idx_q : joint.idx_q + 2] = np.cos(angle), np.sin(angle)
        return out

    def mass_matrix(self, q: np.ndarray) -> np.ndarray:
        M = pin.crba(self.theirs, self.data, self.configuration(q))
        M = np.triu(M) + np.triu(M, 1).T  # only the upper triangle is promised
        return self.C(q).T @ M @ self.C(q)

    def inverse_dynamics(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        C = self.C(q)
        return C.T @ pin.rnea(self.theirs, self.data, self.configuration(q), C @ v, C @ a)

    def gravity(self, q: np.ndarray) -> np.ndarray:
        own = self.configuration(q)
        return self.C(q).T @ pin.computeGeneralizedGravity(self.theirs, self.data, own)

    def gravity_bound(self, M: np.ndarray) -> np.ndarray:
        return np.linalg.norm(self.ours.gravity) * np.sqrt(self.mass * M.diagonal())


def random_configurations(name: str, count: int = 20):
    rng, model = np.random.default_rng(sum(map(ord, name))), load(name)
    for _ in range(count):
        dv, v, a = (rng.uniform(-most, most, model.n_v) for most in (1.4, 2, 5))
        yield model.integrate(model.neutral(), dv), v, a


def assert_close(name: str, ours: np.ndarray, theirs: np.ndarray, bound: np.ndarray) -> None:
    """Name the coordinates that differ by more than TOLERANCE of their bound."""
    wrong = np.abs(ours - theirs) > TOLERANCE * bound
    names = load(name).velocity_names
    where = ["/".join(names[k] for k in index) for index in np.argwhere(wrong)]
    worst = np.max(np.abs(ours - theirs) / bound)
    assert not where, f"{name}: {', '.join(where[:10])} differ, at worst by {worst:.1e}"


each_robot = pytest.mark.parametrize("name", list(ROBOTS))


@each_robot
def test_loads(name):
    robot = ROBOTS[name]
    with pytest.warns(saltus.ModelWarning) as caught:
        model = load_anew(name)
    assert model.n_v == robot.n_v
    assert [str(warning.message) for warning in caught] == model.warnings
    assert any(robot.warning in text for text in model.warnings)


@each_robot
def test_collision_meshes_are_hulls(name):
    hulls = [s.shape for s in load(name).shapes if isinstance(s.shape, saltus.Convex)]
    meshes = ET.parse(robots_folder() / ROBOTS[name].path).findall("link/collision/geometry/mesh")
    assert len(hulls) == len(meshes)
    for hull in hulls:
        assert all(len(face) >= 3 for face in hull.faces)
        size = np.ptp(hull.vertices, axis=0)
        assert (size > 1e-3).all()
        assert (size < 2).all()


@pytest.mark.parametrize("name", [name for name, robot in ROBOTS.items() if robot.srdf])
@pytest.mark.filterwarnings("ignore::saltus.ModelWarning")
def test_srdf_names_its_links(name):
    model = load_anew(name, srdf=robots_folder() / ROBOTS[name].srdf)
    assert not [text for text in model.warnings if "has not" in text]
    assert set(model.pair_names) <= set(load(name).pair_names)


@each_robot
def test_mass_matrix(name):
    twin = Twin(name)
    for q, _, _ in random_configurations(name):
        M = twin.mass_matrix(q)
        scale = np.sqrt(M.diagonal())
        assert_close(name, twin.ours.mass_matrix(q), M, np.outer(scale, scale))


@each_robot
def test_momentum(name):
    twin = Twin(name)
    for q, v, _ in random_configurations(name):
        M = twin.mass_matrix(q)
        bound = np.sqrt(M.diagonal()) * (np.sqrt(M.diagonal()) @ np.abs(v))
        assert_close(name, twin.ours.state(q, v).p, M @ v, bound)


@each_robot
def test_gravity(name):
    twin = Twin(name)
    for q, _, _ in random_configurations(name):
        L_q = twin.ours.lagrangian(q, None).L_q
        bound = twin.gravity_bound(twin.mass_matrix(q))
        assert_close(name, -L_q, twin.gravity(q), bound)


@each_robot
def test_inverse_dynamics(name):
    """d/dt L_v - L_q, with its velocity-dependent terms, is the recursive Newton-Euler force.

    Of a free base the torque is L_q + w x L_v, since L_q holds w in the world's axes.
    """
    twin = Twin(name)
    for q, v, a in random_configurations(name):
        L = twin.ours.lagrangian(q, v)
        force = L.L_vv @ a + L.L_vq @ v - L.L_q
        if twin.floating:
            force[3:6] -= np.cross(v[3:6], L.L_v[3:6])
        bound = np.abs(L.L_vv) @ np.abs(a) + np.abs(L.L_vq) @ np.abs(v) + np.abs(L.L_q)
        bound += twin.gravity_bound(L.L_vv)
        assert_close(name, force, twin.inverse_dynamics(q, v, a), bound)


def free_run(name: str, h: float) -> saltus.Trajectory:
    """Let the robot fall from zero, its joints turning slowly: no motors, limits, contacts."""
    model = load(name)
    v = 0.5 * np.cos(np.arange(model.n_v))
    return saltus.simulate(model, v=v, duration=1.0, h=h, collisions=False, progress=False)


@each_robot
def test_steps_freely_for_a_second(name):
    """The error of energy, over the greatest kinetic energy, is O(h^2) and nothing else."""
    coarse, fine = (free_run(name, h) for h in (1e-3, 5e-4))
    assert coarse.complete
    assert np.isfinite(coarse.q).all()
    assert np.isfinite(coarse.p).all()
    assert coarse.energy_error < ROBOTS[name].energy_band
    assert coarse.energy_error / fine.energy_error == pytest.approx(4, rel=0.05)
