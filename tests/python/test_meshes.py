"""Meshes and convex solids, groups, SRDF: what Python adds to the C++ tests of these."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import saltus
from saltus import AdjacentLinks, Convex, Ellipsoid, MeshUse, ModelBuilder, ModelWarning, Sphere

TETRAHEDRON = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
OBJ = (
    "".join(f"v {x} {y} {z}\n" for x, y, z in TETRAHEDRON) + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
)
INERTIA = "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
BODY = f"<inertial><mass value='1'/>{INERTIA}</inertial>"
SPHERE = "<collision><geometry><sphere radius='0.1'/></geometry></collision>"
MESH = "<collision><geometry><mesh filename='a.obj'/></geometry></collision>"


def urdf(collision: str, block: str = "") -> str:
    """Three free bodies a, b, c with this on each."""
    links = "".join(f"<link name='{name}'>{BODY}{collision}</link>" for name in "abc")
    joints = "".join(
        f"<joint name='to_{name}' type='floating'><parent link='base'/>"
        f"<child link='{name}'/></joint>"
        for name in "abc"
    )
    return f"<robot name='r'><link name='base'/>{links}{joints}<saltus>{block}</saltus></robot>"


@pytest.fixture
def robot(tmp_path):
    """Path of a URDF file with a mesh beside it."""
    (tmp_path / "a.obj").write_text(OBJ)
    path = tmp_path / "robot.urdf"
    path.write_text(urdf(MESH))
    return path


def load(*arguments, **options) -> saltus.Model:
    with pytest.warns(ModelWarning):
        return saltus.load_urdf(*arguments, **options)


def test_convex_is_the_hull_of_its_points():
    inside = np.full((1, 3), 0.1)
    convex = Convex(np.vstack([inside, TETRAHEDRON, TETRAHEDRON]))
    np.testing.assert_array_equal(convex.vertices, TETRAHEDRON)
    assert sorted(sorted(face) for face in convex.faces) == [
        [0, 1, 2],
        [0, 1, 3],
        [0, 2, 3],
        [1, 2, 3],
    ]
    for face in convex.faces:  # counterclockwise seen from outside
        a, b, c = convex.vertices[face]
        assert np.cross(b - a, c - a) @ (a - convex.vertices.mean(axis=0)) > 0
    assert repr(convex) == "Convex(4 vertices, 4 faces)"
    assert saltus.shape_name(convex) == "convex"
    assert Convex(TETRAHEDRON.tolist()).vertices.shape == (4, 3)


def test_convex_needs_a_solid():
    with pytest.raises(saltus.ModelError, match="points: 4 points that lie in a plane: 1"):
        Convex([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])
    with pytest.raises(saltus.ModelError, match="points: 0 points"):
        Convex(np.empty((0, 3)))
    with pytest.raises(saltus.ModelError, match="point 1 is not finite"):
        Convex([(0, 0, 0), (np.nan, 0, 0), (0, 1, 0), (1, 1, 0)])
    with pytest.raises(TypeError):
        Convex([(0, 0), (1, 0), (0, 1), (1, 1)])


def test_ellipsoid():
    ellipsoid = Ellipsoid((0.1, 0.2, 0.3))
    np.testing.assert_array_equal(ellipsoid.radii, [0.1, 0.2, 0.3])
    assert repr(ellipsoid) == "Ellipsoid((0.1, 0.2, 0.3))"
    assert saltus.shape_name(ellipsoid) == "ellipsoid"
    with pytest.raises(saltus.ModelError, match=r"an ellipsoid of size \(0.1 0 1\)"):
        ModelBuilder().add_shape("world", Ellipsoid((0.1, 0, 1)))


def test_shapes_of_a_model():
    builder = ModelBuilder().add_shape("world", Convex(TETRAHEDRON))
    shapes = builder.add_shape("world", Ellipsoid((1, 2, 3))).build().shapes
    np.testing.assert_array_equal(shapes[0].shape.vertices, TETRAHEDRON)
    np.testing.assert_array_equal(shapes[1].shape.radii, [1, 2, 3])


def test_meshes_are_hulls(robot):
    with pytest.warns(ModelWarning, match=r"robot.urdf:1: .* convex hull: \"a.obj\" \(4 of its 4"):
        model = saltus.load_urdf(robot)
    assert [shape.name for shape in model.shapes] == ["a", "b", "c"]
    found = model.shapes[0].shape.vertices
    assert sorted(map(tuple, found)) == sorted(map(tuple, TETRAHEDRON))


def test_meshes_may_be_left_out(robot):
    assert saltus.load_urdf(robot, meshes=MeshUse.none).shapes == []
    assert saltus.read_urdf(robot, meshes=MeshUse.none).warnings == []
    assert saltus.read_urdf(robot, meshes="none").warnings == []
    with pytest.raises(TypeError, match="MeshUse"):
        saltus.load_urdf(robot, meshes=False)


def test_broken_meshes_are_errors(robot):
    (robot.parent / "a.obj").write_text("nothing\n")
    with pytest.raises(
        saltus.ModelError, match=r"robot.urdf:1: link \"a\" has a collision mesh"
    ) as caught:
        saltus.load_urdf(robot)
    assert caught.value.name == "a"


def test_groups_from_urdf():
    groups = "<group name='x' links='a b'/><exclude group1='x' group2='x'/>"
    assert saltus.load_urdf(urdf(SPHERE, groups)).pair_names == ["a ~ c", "b ~ c"]


def test_filters_from_code():
    def pairs(change) -> list[str]:
        builder = ModelBuilder()
        last = "world"
        for name in "abc":
            builder.add_link(name, saltus.solid_sphere(1, 0.1)).add_shape(name, Sphere(0.1))
            builder.add_joint(f"to_{name}", saltus.JointType.revolute, parent=last, child=name)
            last = name
        return change(builder).build().pair_names

    assert pairs(lambda b: b) == ["a ~ c"]
    assert pairs(lambda b: b.set_adjacent_links(AdjacentLinks.watched)) == [
        "a ~ b",
        "a ~ c",
        "b ~ c",
    ]
    assert pairs(lambda b: b.add_body_exclusion("c", "a")) == []
    assert (
        pairs(lambda b: b.set_group("a", "x").set_group("c", "x").add_group_exclusion("x", "x"))
        == []
    )
    with pytest.raises(saltus.ModelError, match="groups are none"):
        pairs(lambda b: b.add_group_exclusion("x", "y"))


def test_srdf(tmp_path):
    text = "<robot><disable_collisions link1='a' link2='b' reason='Never'/></robot>"
    path = tmp_path / "robot.srdf"
    path.write_text(text)
    for srdf in (text, path, str(path)):
        assert saltus.load_urdf(urdf(SPHERE), srdf=srdf).pair_names == ["a ~ c", "b ~ c"]
    with pytest.raises(saltus.ModelError, match=r'no file "nowhere\.srdf"'):
        saltus.load_urdf(urdf(SPHERE), srdf="nowhere.srdf")
    model = load(urdf(SPHERE), srdf=text.replace("'b'", "'z'"))
    assert len(model.pairs) == 3
    assert "links that the robot has not, z" in model.warnings[0]


def test_command_line(robot):
    def info(*arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "saltus", "info", str(robot), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True)

    shown = info()
    assert "Convex(4 vertices, 4 faces)" in shown.stdout
    assert "used as its convex hull" in shown.stderr
    assert "Convex" not in info("--no-meshes").stdout
    srdf = robot.with_suffix(".srdf")
    srdf.write_text("<robot><disable_collisions link1='a' link2='z'/></robot>")
    assert "the robot has not, z" in info("--srdf", str(srdf)).stderr


def test_vertices_are_the_decimals_of_the_file(tmp_path):
    """Single precision, as Assimp keeps it, would let a cube overlap its floor by 1.5e-9 m."""
    corners = [(x, y, z) for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (-0.1, 0.1)]
    faces = ["1 2 4", "1 4 3", "5 7 8", "5 8 6", "1 5 6", "1 6 2", "3 4 8", "3 8 7", "1 3 7"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    (tmp_path / "a.obj").write_text("\n".join(lines) + "\n")
    (tmp_path / "cubes.urdf").write_text(urdf(MESH))
    vertices = load(tmp_path / "cubes.urdf").shapes[0].shape.vertices
    assert set(np.abs(vertices).ravel()) == {0.1}


def test_runs_without_pairs_of_meshes_keep_their_model(robot, tmp_path):
    model = load(robot).without_collisions()
    run = saltus.simulate(model, duration=0.1, progress=False)
    run.save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.coordinate_names == run.model.coordinate_names
