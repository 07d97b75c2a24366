"""Scenes for people: bodies and floors in one call, two robots in one world, and typing errors."""

from __future__ import annotations

import pickle
import warnings

import numpy as np
import pytest
from scenes import BALL, chain_on_a_body

import saltus
from saltus import Box, ContactProperties, JointType, ModelBuilder, Pose, Sphere

G = 9.81


def simulate(builder: ModelBuilder, **options: object) -> saltus.Trajectory:
    return saltus.simulate(builder.build(), progress=False, **options)


def height(run: saltus.Trajectory, link: str) -> np.ndarray:
    return run.poses(link)[:, 2, 3]


def floor_and(*names: str, **floor: object) -> ModelBuilder:
    builder = ModelBuilder("scene").add_floor(**floor)
    for i, name in enumerate(names):
        builder.add_body(name, Sphere(0.1), mass=1, X=Pose((i, 0, 1.1)))
    return builder


def test_every_shape_comes_to_rest_on_a_floor():
    corners = [(x, y, z) for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (0, 0.1)]
    shapes = {
        "ball": (Sphere(0.1), 0.1),
        "box": (Box((0.3, 0.2, 0.1)), 0.1),
        "can": (saltus.Cylinder(0.1, 0.15), 0.15),
        "hull": (saltus.Convex(corners), 0.0),
    }
    builder = ModelBuilder().add_floor().set_default_contact(restitution=0, friction=0.5)
    for i, (name, (shape, lowest)) in enumerate(shapes.items()):
        builder.add_body(name, shape, density=1000, X=Pose((i, 0, lowest + 0.1)))
    run = simulate(builder, duration=0.5)
    for name, (_, lowest) in shapes.items():
        # they fall flat, and all contacts of an impact with e = 0 are resolved together
        assert height(run, name)[-1] == pytest.approx(lowest, abs=1e-9), name
    assert abs(run.v[-1]).max() < 1e-9


def test_a_floor_s_restitution_is_that_of_the_rebound():
    run = simulate(floor_and("ball", restitution=0.5), duration=0.75, h=0.001)
    fall = np.sqrt(2 * 1 / G)
    after = run.t > run.impacts["t"][0]
    # apex e^2 of the height, midway between rows at worst: g h^2 / 8 = 1e-6
    assert fall == pytest.approx(run.impacts["t"][0], abs=1e-9)
    assert height(run, "ball")[after].max() == pytest.approx(0.1 + 0.25, abs=2e-6)


def test_two_floors_have_two_restitutions():
    """A ball meets a dull wall at 1 s, and at a quarter of its speed a lively one at 9 s."""
    builder = ModelBuilder().set_gravity((0, 0, 0))
    builder.add_floor("lively", normal=(1, 0, 0), offset=-1.1, restitution=1)
    builder.add_floor("dull", normal=(-1, 0, 0), offset=-1.1, restitution=0.25)
    builder.add_body("ball", Sphere(0.1), mass=1)
    run = simulate(builder, v=[1, 0, 0, 0, 0, 0], duration=12)
    np.testing.assert_allclose(run.impacts["t"], [1, 9], rtol=0, atol=1e-9)
    assert run.v[-1][0] == pytest.approx(0.25, abs=1e-12)
    assert run.poses("ball")[-1, 0, 3] == pytest.approx(-1 + 3 * 0.25, abs=1e-9)


@pytest.mark.parametrize("mu", [0.1, 0.5])
def test_a_floor_s_friction_holds_or_lets_slide(mu):
    slope = np.array((np.sin(0.3), 0, np.cos(0.3)))
    X = Pose(0.1 * slope, saltus.rotation_from_rpy(0, 0.3, 0))
    builder = ModelBuilder().add_floor("slope", normal=slope, friction=mu)
    builder.add_body("box", Box((0.2, 0.2, 0.1)), mass=2, X=X)
    run = simulate(builder.set_default_contact(restitution=0, friction=9), duration=0.5)
    way = np.linalg.norm(run.poses("box")[-1, :3, 3] - X.p)
    a = max(0.0, G * (np.sin(0.3) - mu * np.cos(0.3)))
    assert way == pytest.approx(a * 0.5**2 / 2, abs=1e-9)  # a parabola, to rounding


def test_one_of_a_floor_s_properties_makes_the_other_zero():
    model = floor_and("ball", friction=0.5).build()
    assert model.contact_properties(0) == ContactProperties(restitution=0, friction=0.5)
    model = floor_and("ball", restitution=0.5).build()
    assert model.contact_properties(0) == ContactProperties(restitution=0.5, friction=0)


def test_inertias_are_the_shapes():
    half = (0.1, 0.2, 0.3)
    corners = [np.array(half) * (x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for shape in (Box(half), saltus.Convex(corners)):
        body = saltus.solid_inertia(2.0, shape)
        np.testing.assert_allclose(body.I_J, saltus.solid_box(2.0, half).I_J, atol=1e-15)
        assert saltus.volume(shape) == pytest.approx(0.048)
    model = ModelBuilder().add_body("a", Box(half), density=1000).build()
    assert model.links[1].mass == pytest.approx(48)
    assert model.coordinate_names[0] == "a_x"


@pytest.mark.parametrize(
    ("make", "error", "parts"),
    [
        (lambda b: b.add_body("x", Sphere(1)), saltus.ModelError,
         ['"x" has neither mass [kg] nor density']),
        (lambda b: b.add_body("x", Sphere(1), mass=1, density=1), saltus.ModelError,
         ["a mass and a density"]),
        (lambda b: b.add_body("x", Sphere(1), mass=0), saltus.ModelError,
         ["mass 0", "fixed joint"]),
        (lambda b: b.add_body("x", saltus.HalfSpace(), mass=1), saltus.ModelError, ["add_floor"]),
        (lambda b: b.add_body("x", (1, 1, 1), mass=1), TypeError, ["shape", "Sphere", "Box"]),
        (lambda b: b.add_body("x", Sphere(1), 1.0), TypeError, ["name, shape, the others by name"]),
        (lambda b: b.add_body("x", Sphere(1), mas=1.0), TypeError, ['no argument "mas"', "mass"]),
        (lambda b: b.add_body("x", Sphere(1), mass=1, joint="floting"), saltus.ModelError,
         ["joint", "'floting'", "did you mean 'floating'?"]),
        (lambda _: floor_and().add_body("x", Sphere(1), mass=1, parent="wrld").build(),
         saltus.ModelError, ['"wrld"', "world, x"]),
        (lambda b: b.add_body("a", Sphere(1), mass=1), saltus.ModelError, ['"a"', "joint_name"]),
        (lambda b: b.add_floor("ground"), saltus.ModelError, ['the plane of half-space "floor"']),
        (lambda b: b.add_floor(offset=-1), saltus.ModelError, ['two half-spaces', '"floor"']),
        (lambda b: b.add_floor("ice", offset=-1, friction=-1), saltus.ModelError, ["friction -1"]),
        (lambda b: b.add_floor("ice", (0, 0, 1)), TypeError, ["it takes name, the others by name"]),
        (lambda b: b.add_floor("ice", offset=-1, mu=1), TypeError,
         ['no argument "mu"', "friction"]),
        (lambda b: b.add("robot.urdf"), TypeError,
         ["other = 'robot.urdf'", "ModelBuilder or Model"]),
        (lambda b: b.add(b), saltus.ModelError, ['"scene_"', "prefix"]),
        (lambda b: b.add(b, "x_", parent="b"), saltus.ModelError, ['"b"', "world, a"]),
        (lambda _: ContactProperties(0, 0.5), TypeError,
         ["without a name", "restitution, friction"]),
        (lambda _: ContactProperties(restitution=2), saltus.ModelError, ["restitution 2"]),
        (lambda _: ContactProperties(mu=2), TypeError, ['no argument "mu"', "friction"]),
        (lambda _: saltus.load_urdf(BALL, contact=(0, 0.5)), TypeError,
         ["contact = (0, 0.5)", "ContactProperties"]),
        (lambda _: saltus.solid_inertia(1, saltus.HalfSpace()), saltus.ModelError, ["no end"]),
        (lambda _: saltus.volume(Sphere(-1)), saltus.ModelError, ["-1"]),
    ],
)  # fmt: skip
def test_typing_errors_are_told_in_words(make, error, parts):
    builder = floor_and("a", restitution=0.3, friction=0.4)
    with pytest.raises(error) as caught:
        make(builder)
    for part in parts:
        assert part in str(caught.value)
    assert builder.build().link_names == ["world", "a"]


def test_nothing_said_of_a_floor_is_a_warning():
    with pytest.warns(saltus.ModelWarning, match='where "a" meets "floor"') as record:
        model = floor_and("a").build()
    assert record[0].filename == __file__
    assert [str(w.message) for w in record] == model.warnings
    assert model.default_contact is None
    with pytest.warns(saltus.ModelWarning, match="contact= of load_urdf") as record:
        model = saltus.load_urdf(BALL, root_joint=JointType.floating, floor=True)
    assert record[0].filename == __file__
    assert model.pair_names == ["ball ~ floor"]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert pickle.loads(pickle.dumps(model)).warnings == model.warnings
        saltus.load_urdf(BALL, floor=True)  # its root is fixed
        floor_and("a", friction=0.5).build()
        floor_and("a").set_default_contact(restitution=1, friction=0).build()


@pytest.mark.parametrize("height", [0.0, 0.5, 1])
def test_floor_of_load_urdf_is_no_height(height):
    """Neither is 0.0 no floor, nor 0.5 a floor at 0."""
    with pytest.raises(TypeError, match=rf"floor = {height} \(.*\), which is no bool"):
        saltus.load_urdf(BALL, root_joint=JointType.floating, floor=height)


def test_urdf_options_come_before_the_file(tmp_path):
    said = "<saltus><contact restitution='0.1' friction='0.1'/><half_space name='ground'/></saltus>"
    path = tmp_path / "ball.urdf"
    path.write_text(BALL.replace("</robot>", said + "</robot>"))
    free = {"root_joint": JointType.floating, "floor": True}
    model = saltus.load_urdf(path, **free)
    assert model.default_contact == ContactProperties(restitution=0.1, friction=0.1)
    assert model.pair_names == ["ball ~ ground"]  # the file has this floor
    other = ContactProperties(restitution=0, friction=0.7)
    assert saltus.load_urdf(path, contact=other, **free).contact_properties(0) == other
    path.write_text(path.read_text().replace("name='ground'", "name='floor' offset='-1'"))
    assert saltus.load_urdf(path, **free).pair_names == ["ball ~ floor", "ball ~ floor_"]


def test_files_of_runs_keep_floor_and_contact(tmp_path):
    properties = ContactProperties(restitution=0.25, friction=0.5)
    options = {"root_joint": JointType.floating, "floor": True}
    model = saltus.load_urdf(BALL, contact=properties, **options)
    run = saltus.simulate(model, q={"root_z": 0.5}, duration=0.5, progress=False)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5").model
    assert again.contact_properties(0) == properties
    assert again.default_contact == properties
    # a builder that was told more than the text says
    builder = saltus.read_urdf(BALL, **options).set_contact("floor", "floor", friction=0.1)
    builder.set_material("ball", "floor")
    changed = saltus.simulate(builder.build(), q={"root_z": 0.5}, duration=0.1, progress=False)
    changed.save(tmp_path / "changed.h5")
    again = saltus.load(tmp_path / "changed.h5").model
    assert again.contact_properties(0).friction == 0.1
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        loud = saltus.load_urdf(BALL, **options)
    with warnings.catch_warnings():  # said once, where the model was made
        warnings.simplefilter("error")
        run = saltus.simulate(loud, q={"root_z": 0.5}, duration=0.1, progress=False)
        run.save(tmp_path / "loud.h5")
        assert saltus.load(tmp_path / "loud.h5").model.warnings == loud.warnings


def test_two_robots_move_as_each_alone():
    robot = saltus.read_urdf(chain_on_a_body(2))
    alone = robot.build()
    world = ModelBuilder("world").add(robot, "left_").add(alone, "right_", X=Pose((0, 2, 0)))
    assert world.build().coordinate_names == [
        f"{side}_joint_{i}" for side in ("left", "right") for i in (0, 1)
    ]
    starts = {"left": {"joint_0": 0.3, "joint_1": -0.2}, "right": {"joint_0": -1.0}}
    both = simulate(
        world,
        q={f"{side}_{name}": x for side, q in starts.items() for name, x in q.items()},
        duration=0.5,
    )
    for side, q in starts.items():
        run = saltus.simulate(alone, q=q, duration=0.5, progress=False)
        for name in alone.coordinate_names:
            # the same equations, solved in other lanes
            np.testing.assert_allclose(
                both.column(f"{side}_{name}"), run.column(name), rtol=0, atol=1e-12
            )


def test_robots_of_files_meet_on_one_floor():
    options = {"root_joint": JointType.floating, "floor": True}
    contact = ContactProperties(restitution=0, friction=0.3)
    ball = saltus.load_urdf(BALL, contact=contact, **options)
    world = ModelBuilder().add(ball, "a_").add(ball, "b_", X=Pose((1, 0, 0)))
    model = world.build()
    assert model.pair_names == ["a_ball ~ a_floor", "a_ball ~ b_ball", "b_ball ~ a_floor"]
    assert model.default_contact == contact
    assert model.warnings == []
    elastic = saltus.read_urdf(BALL, contact=ContactProperties(), **options)
    with pytest.raises(
        saltus.ModelError, match=r"restitution 0 and friction 0\.3.* 1 and friction 0"
    ):
        world.add(elastic, "c_")
    assert world.build().n_q == model.n_q
