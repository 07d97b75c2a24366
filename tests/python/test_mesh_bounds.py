"""Mesh files that would take a reader's stack, memory or hours, and large ones that are read."""

from __future__ import annotations

import struct
import warnings

import numpy as np
import pytest
from mesh_texts import dae, obj

import saltus

INERTIA = '<inertia ixx=".007" ixy="0" ixz="0" iyy=".007" iyz="0" izz=".007"/>'
BODY = f'<inertial><mass value="1"/>{INERTIA}</inertial>'
HERE = '<instance_geometry url="#g"/>'


def urdf(name: str, element: str = "collision") -> str:
    mesh = f'<{element}><geometry><mesh filename="{name}"/></geometry></{element}>'
    return f'<robot name="r"><link name="body">{BODY}{mesh}</link></robot>'


def load(folder, name: str, **options) -> saltus.Model:
    (folder / "r.urdf").write_text(urdf(name))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", saltus.ModelWarning)
        return saltus.load_urdf(folder / "r.urdf", **options)


def node(name: str, inside: str) -> str:
    return f'<node id="{name}">{inside}</node>'


def instance(*names: str) -> str:
    return "".join(f'<instance_node url="#{name}"/>' for name in names)


def library(*nodes: str) -> str:
    return f"<library_nodes>{''.join(nodes)}</library_nodes>"


def doubling(count: int) -> str:
    nodes = [node(f"n{i}", instance(f"n{i + 1}", f"n{i + 1}")) for i in range(count)]
    return library(*nodes, node(f"n{count}", HERE))


REFUSED = {
    "itself": (library(node("a", instance("a"))), instance("a"), 'node "a" that contains itself'),
    "a circle": (
        library(node("a", instance("b")), node("b", instance("a"))),
        instance("a"),
        "that contains itself",
    ),
    "its parent": ("", node("a", node("b", instance("a"))), 'node "a" that contains itself'),
    "two to the sixtieth": (doubling(60), instance("n0"), "more than 100000 nodes"),
    "many at once": (doubling(10), instance("n0") * 1000, "more than 100000 nodes"),
    "a long chain": (
        library(*(node(f"n{i}", instance(f"n{i + 1}")) for i in range(5000)), node("n5000", HERE)),
        instance("n0"),
        "nested more than 500 deep",
    ),
    "deep elements": ("", "<node>" * 20000 + HERE + "</node>" * 20000, "nested more than 500 deep"),
}


@pytest.mark.parametrize("kind", list(REFUSED))
def test_nodes_that_never_end(tmp_path, kind):
    more, scene, words = REFUSED[kind]
    inside = scene if scene.startswith("<node") else f"<node>{scene}</node>"
    (tmp_path / "a.dae").write_text(dae(inside, more=more))
    with pytest.raises(saltus.ModelError, match=f'has a collision mesh, "a.dae", which .*{words}'):
        load(tmp_path, "a.dae")
    (tmp_path / "r.urdf").write_text(urdf("a.dae", "visual"))
    with pytest.warns(saltus.ModelWarning, match=words):
        assert saltus.load_urdf(tmp_path / "r.urdf").visuals == []


def test_nodes_that_are_instances_several_times(tmp_path):
    places = [f"<node><translate>{x} 0 0</translate>{instance('a')}</node>" for x in (0, 5)]
    (tmp_path / "a.dae").write_text(dae("".join(places), more=library(node("a", HERE))))
    [hull] = load(tmp_path, "a.dae").shapes
    np.testing.assert_allclose(np.ptp(hull.shape.vertices, axis=0), (6, 1, 1))


def test_a_unit_is_the_decimal_number_that_the_file_has(tmp_path):
    """A cube of 200 mm in millimetres; 0.001 in single precision would be 4.7e-8 off."""
    corners = [(x, y, z) for x in (-100, 100) for y in (-100, 100) for z in (-100, 100)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    unit = '<unit name="millimeter" meter="0.001"/>'
    (tmp_path / "a.dae").write_text(dae(f"<node>{HERE}</node>", corners, faces, unit))
    model = load(tmp_path, "a.dae", root_joint="floating", floor=True)
    assert set(np.abs(model.shapes[0].shape.vertices).ravel()) == {0.1}
    pose = saltus.Pose((0, 0, 0.1))
    assert model.gaps({"root": pose}).phi.min() == 0
    assert saltus.simulate(model, q={"root": pose}, duration=0.05).complete


@pytest.mark.parametrize("corners", [3, 4])
@pytest.mark.parametrize("up", [True, False])
def test_a_flat_mesh_is_a_plate_below_the_side_it_looks_at(tmp_path, corners, up):
    square = [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)][:corners]
    order = range(corners) if up else reversed(range(corners))
    (tmp_path / "a.obj").write_text(obj(square, [list(order)]))
    (tmp_path / "r.urdf").write_text(urdf("a.obj"))
    words = r'plane.*a floor is <half_space name="floor"/> in <saltus>.*'
    with pytest.warns(saltus.ModelWarning, match=words + "read as a thin plate"):
        [plate] = saltus.load_urdf(tmp_path / "r.urdf").shapes
    heights = plate.shape.vertices[:, 2]
    assert (heights.max() if up else heights.min()) == 0
    assert 1e-4 < np.ptp(heights) < 1e-3
    with pytest.raises(saltus.ModelError, match=words):
        load(tmp_path, "a.obj", strict=True)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.stl", "solid it\nendsolid it\n"),
        ("a.stl", "solid it\nfacet normal 0 0 1\nouter loop\nendloop\nendfacet\nendsolid it\n"),
        ("a.obj", "o nothing\n"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\np 1\n"),
        ("a.dae", "<COLLADA/>"),
        ("a.dae", dae("")),
        ("a.dae", dae(f"<node>{HERE}</node>", [], [])),
    ],
)
def test_files_with_nothing_in_them(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(saltus.ModelError, match=f'has a collision mesh, "{name}", which '):
        load(tmp_path, name)


def test_a_line_is_no_plate(tmp_path):
    (tmp_path / "a.obj").write_text(obj([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [range(3)]))
    with pytest.raises(saltus.ModelError, match="has no convex hull"):
        load(tmp_path, "a.obj")


def test_a_mesh_of_an_unknown_format_is_not_used(tmp_path):
    (tmp_path / "a.glb").write_bytes(b"glTF")
    (tmp_path / "r.urdf").write_text(urdf("a.glb"))
    words = r'collision mesh, "a.glb", which has an unknown format, ".glb"; known are .stl, .obj'
    with pytest.warns(saltus.ModelWarning, match=words):
        assert saltus.load_urdf(tmp_path / "r.urdf").shapes == []
    with pytest.raises(saltus.ModelError, match=words):
        load(tmp_path, "a.glb", strict=True)


def sphere_stl(rings: int, columns: int) -> tuple[bytes, int]:
    """Return a binary STL of a ball, and its number of triangles."""
    polar = np.linspace(0, np.pi, rings + 1)[:, None]
    turn = np.linspace(0, 2 * np.pi, columns + 1)[None, :]
    points = np.stack(
        [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar) + 0 * turn], -1
    )
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    triangles = np.concatenate([np.stack(x, -2).reshape(-1, 3, 3) for x in ((a, b, c), (a, c, d))])
    facets = np.zeros(len(triangles), [("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    facets["v"] = triangles
    return bytes(80) + struct.pack("<I", len(facets)) + facets.tobytes(), len(facets)


def test_a_mesh_of_three_hundred_thousand_triangles(tmp_path):
    """It took 3 s where this was written; a quadratic algorithm would take hours."""
    data, count = sphere_stl(300, 500)
    assert count == 300_000
    (tmp_path / "a.stl").write_bytes(data)
    (tmp_path / "r.urdf").write_text(urdf("a.stl", "visual"))
    [ball] = saltus.load_urdf(tmp_path / "r.urdf").visuals
    assert len(ball.shape.faces) == pytest.approx(
        count, abs=1100
    )  # those at the poles have no area
    [hull] = load(tmp_path, "a.stl").shapes
    assert len(hull.shape.vertices) > 100_000


def test_a_file_of_more_bytes_than_are_read(tmp_path):
    with open(tmp_path / "a.obj", "wb") as file:
        file.truncate((256 << 20) + 1)  # a hole: it takes no room
    with pytest.raises(saltus.ModelError, match="more than 256 MiB"):
        load(tmp_path, "a.obj")


@pytest.mark.parametrize("ending", ["obj", "dae", "stl"])
def test_a_pointer_of_git_lfs(tmp_path, ending):
    (tmp_path / f"a.{ending}").write_text("version https://git-lfs.github.com/spec/v1\n")
    with pytest.raises(saltus.ModelError, match="pointer of Git LFS"):
        load(tmp_path, f"a.{ending}")


def test_a_robot_of_twenty_thousand_links():
    """It took a second where this was written; each name against all others took minutes."""
    link = f'<link name="l{{0}}">{BODY}</link>'
    joint = (
        '<joint name="j{1}" type="{2}"><parent link="l{0}"/><child link="l{1}"/>'
        '<origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint>'
    )
    for kind, parent in (("fixed", lambda i: i - 1), ("continuous", lambda i: i // 2)):
        parts = [link.format(0)]
        parts += [link.format(i) + joint.format(parent(i), i, kind) for i in range(1, 20_000)]
        model = saltus.load_urdf(f'<robot name="r">{"".join(parts)}</robot>')
        assert len(model.links) == 20_000
    assert model.n_q == 19_999
