"""What links look like: read from URDF, kept by builders and pickles, never a reason to fail."""

from __future__ import annotations

import pickle
import warnings

import numpy as np
import pytest
from mesh_texts import FACES, TETRAHEDRON, dae, obj

import saltus
from saltus import ModelBuilder, TriangleMesh

PAINT = "<material name='red'><color rgba='1 0 0 0.5'/></material>"


def visual(geometry: str, material: str = "", origin: str = "") -> str:
    return f"<visual>{origin}<geometry>{geometry}</geometry>{material}</visual>"


def urdf(visuals: str, more: str = "") -> str:
    return f"<robot name='r'>{more}<link name='base'>{visuals}</link></robot>"


def load(folder, looks: str, more: str = "", **options) -> saltus.Model:
    """Load without a warning."""
    (folder / "r.urdf").write_text(urdf(looks, more))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return saltus.load_urdf(folder / "r.urdf", **options)


def only(folder, looks: str, more: str = "") -> saltus.Visual:
    [one] = load(folder, looks, more).visuals
    return one


def assert_mesh(mesh: TriangleMesh, vertices, faces) -> None:
    """Compare triangle by triangle, each from its least corner, by where corners are."""

    def turned(triangles):
        rows = [[tuple(p) for p in triangle] for triangle in np.round(triangles, 9)]
        return sorted(t[t.index(min(t)) :] + t[: t.index(min(t))] for t in rows)

    expected = np.asarray(vertices, float)[np.asarray(faces)]
    assert turned(mesh.vertices[mesh.faces]) == turned(expected)


@pytest.mark.parametrize(
    ("geometry", "kind", "shown"),
    [
        ("<box size='2 4 6'/>", "box", "Box((1.0, 2.0, 3.0))"),
        ("<sphere radius='2'/>", "sphere", "Sphere(2.0)"),
        ("<cylinder radius='2' length='6'/>", "cylinder", "Cylinder(2.0, 3.0)"),
        ("<capsule radius='2' length='6'/>", "capsule", "Capsule(2.0, 3.0)"),
    ],
)
def test_shapes_with_their_sizes(tmp_path, geometry, kind, shown):
    one = only(tmp_path, visual(geometry, origin="<origin xyz='1 2 3' rpy='0 0 0.5'/>"))
    assert (one.link, one.kind, repr(one.shape)) == ("base", kind, shown)
    assert repr(one) == f"Visual('base', {shown})"
    np.testing.assert_allclose(one.X_LG.matrix()[:3, 3], (1, 2, 3))
    np.testing.assert_allclose(one.X_LG.R, saltus.rotation_from_rpy(0, 0, 0.5), atol=1e-15)


def test_colours(tmp_path):
    box = "<box size='1 1 1'/>"
    named, unknown = "<material name='blue'/>", "<material name='lost'/>"
    blue = "<material name='blue'><color rgba='0 0 1 1'/></material>"
    again = "<material name='red'/>"
    looks = [visual(box, material) for material in ("", PAINT, named, unknown, again)]
    found = [v.rgba for v in load(tmp_path, "".join(looks), blue).visuals]
    grey = [0.7, 0.7, 0.7, 1.0]
    assert found == [grey, [1, 0, 0, 0.5], [0, 0, 1, 1], grey, [1, 0, 0, 0.5]]


def test_meshes_are_triangles(tmp_path):
    (tmp_path / "a.obj").write_text(obj())
    one = only(tmp_path, visual("<mesh filename='a.obj'/>", PAINT))
    assert (one.kind, one.rgba) == ("mesh", [1, 0, 0, 0.5])
    assert repr(one.shape) == "TriangleMesh(4 vertices, 4 faces)"
    assert_mesh(one.shape, TETRAHEDRON, FACES)
    assert not one.shape.vertices.flags.writeable
    assert not one.shape.faces.flags.writeable


def test_a_mirrored_mesh_keeps_its_outside_outside(tmp_path):
    (tmp_path / "a.obj").write_text(obj())
    one = only(tmp_path, visual("<mesh filename='a.obj' scale='1 -2 3'/>"))
    assert_mesh(one.shape, TETRAHEDRON * (1, -2, 3), FACES[:, ::-1])


def test_polygons_become_triangles(tmp_path):
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 0.5, 0), (0, 2, 0)]  # not convex
    (tmp_path / "a.obj").write_text(obj(corners, [range(5)]))
    mesh = only(tmp_path, visual("<mesh filename='a.obj'/>")).shape
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    assert np.cross(b - a, c - a)[:, 2].sum() / 2 == pytest.approx(2.5)
    assert len(mesh.faces) == 3


def painted(colour: str) -> str:
    return (
        "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><lambert><diffuse>"
        f"<color>{colour}</color></diffuse></lambert></technique></profile_COMMON></effect>"
        "</library_effects><library_materials><material id='paint'><instance_effect url='#e'/>"
        "</material></library_materials>"
    )


def test_colours_of_the_mesh_itself(tmp_path):
    """A material of the URDF takes their place; transforms and the unit are applied."""
    bind = (
        "<bind_material><technique_common><instance_material symbol='m' target='#paint'/>"
        "</technique_common></bind_material>"
    )
    node = (
        "<node id='n'><translate>1 0 0</translate>"
        f"<instance_geometry url='#g'>{bind}</instance_geometry></node>"
    )
    unit = "<unit name='centimeter' meter='0.01'/>"
    text = dae(node, asset=unit, more=painted("0.25 0.5 0.75 1"))
    (tmp_path / "a.dae").write_text(text)
    one = only(tmp_path, visual("<mesh filename='a.dae'/>"))
    assert one.rgba == [0.25, 0.5, 0.75, 1]
    assert_mesh(one.shape, 0.01 * np.add(TETRAHEDRON, (1, 0, 0)), FACES)
    assert only(tmp_path, visual("<mesh filename='a.dae'/>", PAINT)).rgba == [1, 0, 0, 0.5]


BROKEN = {
    "<mesh filename='lost.stl'/>": 'visual mesh, "lost.stl", which is not found; looked in ',
    "<mesh filename='bad.stl'/>": 'visual mesh, "bad.stl", which is cut short: it has 7 bytes',
    "<mesh filename='a.blend'/>": 'visual mesh, "a.blend", which has an unknown format',
    "<mesh/>": 'visual of a mesh without attribute "filename"',
    "<mesh filename='a.obj' scale='1 1'/>": 'visual with scale="1 1": 3 numbers are needed',
    "<sphere radius='${r}'/>": 'visual with radius="${r}": 1 number is needed',
    "<sphere radius='0'/>": 'visual with radius="0": a size must be positive',
    "<sphere/>": 'visual without attribute "radius"',
    "<plane/>": "visual of an unknown shape, <plane>",
    "": "visual without a shape",
}


@pytest.mark.parametrize("geometry", list(BROKEN))
def test_what_is_broken_is_left_out_in_words(tmp_path, geometry):
    (tmp_path / "bad.stl").write_bytes(b"garbage")
    for name in ("a.blend", "a.obj"):
        (tmp_path / name).write_text(obj())
    (tmp_path / "r.urdf").write_text(urdf("\n" + visual(geometry) + visual("<box size='1 1 1'/>")))
    with pytest.warns(saltus.ModelWarning) as caught:
        model = saltus.load_urdf(tmp_path / "r.urdf")
    assert [v.kind for v in model.visuals] == ["box"]
    [text] = [str(each.message) for each in caught]
    assert text.startswith(f'{tmp_path / "r.urdf"}:2: link "base" has a {BROKEN[geometry]}')


def test_many_that_are_broken_are_one_warning():
    looks = "".join(visual(f"<mesh filename='{i}.stl'/>") for i in range(30))
    with pytest.warns(saltus.ModelWarning) as caught:
        assert saltus.load_urdf(urdf(looks)).visuals == []
    [text] = [str(each.message) for each in caught]
    assert text.endswith("; so are 29 others")


def test_they_may_be_left_out(tmp_path):
    assert load(tmp_path, visual("<mesh filename='lost.stl'/>"), visuals=False).visuals == []
    with pytest.raises(TypeError):
        saltus.load_urdf(urdf(""), visuals=1)


def test_in_code_and_with_a_prefix():
    mesh = TriangleMesh(TETRAHEDRON, FACES)
    hand = ModelBuilder("hand", root="palm")
    hand.add_visual("palm", mesh, saltus.Pose((1, 2, 3)), rgba=(0, 1, 0, 1), name="skin")
    hand.add_visual("palm", saltus.Box((1, 1, 1)))
    arm = ModelBuilder("arm").add_visual("world", saltus.Sphere(1))
    model = arm.add(hand, "left_").add(hand, "right_", X=saltus.Pose((0, 1, 0))).build()
    assert [v.link for v in model.visuals] == [
        "world", "left_palm", "left_palm", "right_palm", "right_palm"
    ]  # fmt: skip
    for i in (1, 3):
        skin = model.visuals[i]
        assert (skin.name, skin.rgba) == ("skin", [0, 1, 0, 1])
        assert_mesh(skin.shape, TETRAHEDRON, FACES)
        np.testing.assert_array_equal(skin.X_LG.p, (1, 2, 3))
    assert model.n_pairs == 0
    assert model.shapes == []


def test_pickles_keep_them():
    mesh = TriangleMesh(TETRAHEDRON, FACES)
    builder = ModelBuilder().add_visual("world", mesh, rgba=(0, 0.5, 1, 0.25), name="a")
    model = builder.add_visual("world", saltus.Capsule(1, 2), saltus.Pose((1, 2, 3))).build()
    again = pickle.loads(pickle.dumps(model)).visuals
    assert repr(again) == repr(model.visuals)
    assert (again[0].rgba, again[0].name) == ([0, 0.5, 1, 0.25], "a")
    np.testing.assert_array_equal(again[0].shape.vertices, mesh.vertices)
    np.testing.assert_array_equal(again[0].shape.faces, mesh.faces)
    np.testing.assert_array_equal(again[1].X_LG.p, (1, 2, 3))


def test_what_no_link_looks_like():
    builder, box = ModelBuilder(), saltus.Box((1, 1, 1))
    with pytest.raises(saltus.ModelError, match=r"face of vertex 4; it has vertices 0 to 3"):
        TriangleMesh(TETRAHEDRON, FACES + 1)
    with pytest.raises(saltus.ModelError, match=r"face of vertex -1"):
        TriangleMesh(TETRAHEDRON, FACES - 1)
    with pytest.raises(saltus.ModelError, match="vertex 1 is not finite"):
        TriangleMesh([(0, 0, 0), (np.inf, 0, 0)], np.zeros((0, 3), int))
    with pytest.raises(saltus.ModelError, match="half-space as a visual"):
        builder.add_visual("world", saltus.HalfSpace())
    for rgba in ((0, 0, 2, 1), (0, 0, 0, np.nan), (-1, 0, 0, 0)):
        with pytest.raises(saltus.ModelError, match="are in"):
            builder.add_visual("world", box, rgba=rgba)
    with pytest.raises(saltus.ModelError, match=r"visual is put on link \"x\", which does not"):
        builder.add_visual("x", box).build()
