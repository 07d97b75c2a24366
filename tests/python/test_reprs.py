"""What objects say of themselves: as text, in notebooks, on the command line."""

from __future__ import annotations

import html.parser
import inspect
from enum import Enum

import numpy as np
import pytest
from helpers import run_cli
from scenes import cradle, cradle_run

import saltus


def classes() -> list[str]:
    found = [name for name in saltus.__all__ if inspect.isclass(getattr(saltus, name))]
    return [name for name in found if not issubclass(getattr(saltus, name), Exception)]


@pytest.mark.parametrize("name", classes())
def test_every_class_has_a_repr_of_its_own(name):
    kind = getattr(saltus, name)
    owner = next(base for base in kind.__mro__ if "__repr__" in vars(base))
    assert issubclass(kind, Enum) or owner.__module__.startswith("saltus"), name


def robot() -> saltus.ModelBuilder:
    builder = saltus.ModelBuilder("robot").add_floor(friction=0.5)
    builder.add_body("base", saltus.Sphere(0.1), mass=2.0)
    builder.add_shape("base", saltus.Box((0.1, 0.1, 0.1)))
    for name, axis in (("a", (0, 0, -1)), ("b", (3, 4, 0)), ("c", (1, 0, 0))):
        parent = "base" if name != "b" else "a"
        builder.add_link(name, saltus.solid_sphere(1.0, 0.1))
        builder.add_joint(
            f"to_{name}",
            "prismatic" if name == "c" else "revolute",
            parent=parent,
            child=name,
            axis=axis,
            lower=-1.5 if name == "c" else -np.inf,
            upper=2.0 if name == "c" else np.inf,
            mimic=saltus.Mimic("to_a", -2.0, 0.5) if name == "b" else None,
        )
    builder.add_link("frame")
    builder.add_joint("weld", "fixed", parent="b", child="frame")
    return builder


def test_a_model_prints_as_a_tree():
    assert (
        str(robot().build())
        == """\
robot: 9 coordinates, 8 velocities, 9 pairs, 5 kg
world, 1 half-space
  base (floating): base, 2 kg, 1 sphere, 1 box
    to_a (revolute about -z): a, 1 kg
      to_b (revolute about (0.6, 0.8, 0), = -2 * to_a +0.5): b, 1 kg
        weld (fixed): frame
    to_c (prismatic along x, -1.5 to 2 m): c, 1 kg"""
    )


def test_long_trees_are_cut_in_print_alone():
    model = cradle(100)
    assert len(str(model).splitlines()) == 62
    assert str(model).endswith("... 141 more joints; model_tree(model) has all")
    assert len(saltus.model_tree(model).splitlines()) == 202
    assert len(saltus.model_tree(model, most=5).splitlines()) == 7
    assert repr(model).startswith("Model('cradle_100'")


class Cells(html.parser.HTMLParser):
    """Collects the texts of cells; fails on tags that are not closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.cells: list[str] = []

    def handle_starttag(self, tag, attrs) -> None:
        self.open.append(tag)

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data) -> None:
        self.cells.append(data)


def cells(thing: object) -> list[str]:
    parser = Cells()
    parser.feed(thing._repr_html_())
    parser.close()
    assert not parser.open
    return parser.cells


def test_notebooks_show_tables():
    model = robot().build()
    assert {"to_c", "prismatic", "along x", "-1.5 to 2 m", "1 kg"} <= set(cells(model))
    impact = cells(cradle_run().impact(0))
    assert {"#", "pair", "ball_0 ~ ball_1", "ball_1 ~ ball_2"} <= set(impact)
    batch = saltus.simulate_batch(cradle(), {"swing_0": [0.1, 0.2]}, duration=0.1)
    assert cells(batch)[0] == batch.summary()
    assert cells(batch).count("complete") == 2


def test_names_cannot_become_tags():
    builder = saltus.ModelBuilder("<b>&")
    builder.add_body("<script>", saltus.Sphere(0.1), mass=1.0)
    assert "<script>" in cells(builder.build())


def test_parts_say_what_they_are():
    builder = robot()
    model = builder.build()
    assert repr(builder) == "ModelBuilder('robot', 6 links, 5 joints, 3 shapes)"
    assert repr(model.link("a")) == "Link('a', index=2, mass=1.0)"
    assert repr(model.joint("to_a")) == "JointInfo('to_a', revolute, 'base' -> 'a')"
    assert repr(builder.link("a")) == "BuilderLink('a')"
    assert repr(builder.joint("to_a")) == "BuilderJoint('to_a')"


def test_parts_say_what_matters_of_them():
    builder = robot()
    builder.add_motor("push", joint="to_c")
    model = builder.build()
    of = {coordinate.name: repr(coordinate) for coordinate in model.coordinates}
    assert of["to_a"] == "Coordinate('to_a', [rad])"
    assert of["to_c"] == "Coordinate('to_c', [m], -1.5 to 2)"
    assert of["base_qx"] == "Coordinate('base_qx' of 'base', [1])"
    assert repr(model.joint("to_b").mimic) == "Mimic('to_a', multiplier=-2, offset=0.5)"


def test_reprs_of_large_models_are_short():
    model = cradle(500)
    run = saltus.simulate(model, q={"swing_0": 0.3}, duration=0.51)
    stepper, state = saltus.Stepper(model, h=0.01), run.state(49)
    while not stepper.report.impacts:
        state = stepper.advance(state)
    line = np.eye(500)[1:] - np.eye(500)[:-1]
    hit = saltus.resolve_impact(np.eye(500), line, np.eye(500)[0])
    things = [model, run, state, model.at(), run.impact(0), stepper, stepper.report, hit]
    for thing in things:
        assert len(repr(thing)) < 300, type(thing)
    assert repr(run.impact(0)) == "<saltus.Impact: t = 0.504644 s, 499 impulses on 499 contacts>"
    assert repr(run.state(0)).startswith(
        "State(t=0.0, q=[0.3, 0.0, 0.0, 0.0, 0.0, 0.0, ... 994 more]"
    )
    small = cradle_run()
    assert (
        repr(small.state(0))
        == "State(t=0.0, q=[0.3, 0.0, 0.0, 0.0, 0.0, 0.0], p=" + str([0.0] * 6) + ")"
    )
    assert repr(small.impact(0)).startswith("Impact(t=0.5046")


def test_info_lists_actuators_and_no_empty_columns(tmp_path):
    path = tmp_path / "cradle.urdf"
    path.write_text(saltus.scenes.cradle(2))
    text = run_cli("info", path).stdout
    assert "  name     joint    unit\n" in text
    assert "actuators" not in text
    urdf = (saltus.urdf_dir() / "arm.urdf").read_text()
    motor = '<saltus><motor name="turn" joint="waist"/></saltus>'
    path.write_text(urdf.replace("</robot>", f"{motor}</robot>"))
    assert "actuators\n  name\n  turn\n" in run_cli("info", path).stdout


def test_info_has_no_rows_of_zeros(tmp_path):
    path = tmp_path / "cradle.urdf"
    path.write_text(saltus.scenes.cradle(3))
    text = run_cli("info", path).stdout
    assert "swing_1 (continuous about y): gimbal_1" in text
    rows = [line.split() for line in text.splitlines() if " ~ " in line]
    assert rows == [["sphere", "~", "sphere", "3"]]
    assert not [line for line in text.splitlines() if line.split()[-1:] == ["0"]]
