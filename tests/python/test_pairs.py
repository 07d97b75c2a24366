"""All pairs of shapes: the table, how many gaps each has in a model, and their pictures."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scenes import two_bodies
from tests.conftest import ROOT

import saltus
from saltus import Box, Capsule, Convex, Cylinder, Ellipsoid, HalfSpace, Pose, Sphere

TETRAHEDRON = [(0, 0, 0.4), (0.3, 0, -0.2), (-0.2, 0.3, -0.2), (-0.2, -0.3, -0.2)]
SHAPES = {
    "sphere": Sphere(0.2),
    "capsule": Capsule(0.1, 0.3),
    "box": Box((0.2, 0.3, 0.4)),
    "cylinder": Cylinder(0.2, 0.3),
    "half_space": HalfSpace(),
    "ellipsoid": Ellipsoid((0.2, 0.3, 0.4)),
    "convex": Convex(TETRAHEDRON),
}
# Gaps of a model with one of each: parts that can bear load. The hull has 4 vertices, 6 edges.
GAPS = {
    ("box", "box"): 8 + 8 + 12 * 12,
    ("box", "capsule"): 8 + 2 + 12,
    ("box", "convex"): 8 + 4 + 12 * 6,
    ("box", "cylinder"): 8 + 8 + 12 * 3 + 2,
    ("box", "ellipsoid"): 1,
    ("box", "half_space"): 8,
    ("box", "sphere"): 1,
    ("capsule", "capsule"): 2 + 2 + 1,
    ("capsule", "convex"): 2 + 4 + 6,
    ("capsule", "cylinder"): 2 + 8 + 3 + 2,
    ("capsule", "ellipsoid"): 1,
    ("capsule", "half_space"): 2,
    ("capsule", "sphere"): 1,
    ("convex", "convex"): 4 + 4 + 6 * 6,
    ("convex", "cylinder"): 4 + 8 + 6 * 3 + 2,
    ("convex", "ellipsoid"): 1,
    ("convex", "half_space"): 4,
    ("convex", "sphere"): 1,
    ("cylinder", "cylinder"): 8 + 8 + 1 + 2 + 2 + 2 + 4,
    ("cylinder", "ellipsoid"): 1,
    ("cylinder", "half_space"): 8 + 2,
    ("cylinder", "sphere"): 1,
    ("ellipsoid", "ellipsoid"): 1,
    ("ellipsoid", "half_space"): 1,
    ("ellipsoid", "sphere"): 1,
    ("half_space", "sphere"): 1,
    ("sphere", "sphere"): 1,
}


def both(a, b) -> saltus.Model:
    """Return two free bodies, or one over a half-space."""
    free = {n: s for n, s in (("a", a), ("b", b)) if not isinstance(s, HalfSpace)}
    builder = two_bodies(**free)
    for shape in (a, b):
        if isinstance(shape, HalfSpace):
            builder.add_shape("world", shape)
    return builder.set_default_contact(restitution=1, friction=0).build()


def test_the_table_has_all_27_pairs():
    assert sorted(tuple(sorted(row)) for row in saltus.gap_table()) == sorted(GAPS)
    all_pairs = itertools.combinations_with_replacement(sorted(SHAPES), 2)
    assert set(all_pairs) - set(GAPS) == {("half_space", "half_space")}


@pytest.mark.parametrize("kinds", GAPS, ids="~".join)
def test_every_pair_has_as_many_gaps_as_the_manual_says(kinds):
    model = both(*(SHAPES[kind] for kind in kinds))
    assert model.pair_kinds() == {kinds: GAPS[kinds]}
    assert model.n_pairs == len(set(model.pair_names)) == GAPS[kinds]
    assert not model.warnings


def test_parts_have_the_names_of_the_manual():
    box = both(SHAPES["box"], HalfSpace()).pair_names
    assert box == [f"a[{x}{y}{z}] ~ world" for z in "+-" for y in "+-" for x in "+-"]
    assert both(SHAPES["capsule"], HalfSpace()).pair_names == ["a[+] ~ world", "a[-] ~ world"]
    can = both(SHAPES["cylinder"], HalfSpace()).pair_names
    points = [f"a[{z}{angle}] ~ world" for z in "+-" for angle in (0, 90, 180, 270)]
    assert can == [*points, "a[rim+] ~ world", "a[rim-] ~ world"]
    rock = both(SHAPES["convex"], HalfSpace()).pair_names
    assert rock == [f"a[v{k}] ~ world" for k in range(4)]
    rods = both(SHAPES["capsule"], SHAPES["capsule"]).pair_names
    assert "a[axis] ~ b[axis]" in rods
    rock_on_can = both(SHAPES["convex"], SHAPES["cylinder"]).pair_names
    edge = ["a[e5] ~ b[axis]", "b[in] ~ a[e5]", "b[out] ~ a[e5]"]
    assert {*edge, "b[rim+] ~ a", "b[-90] ~ a"} < set(rock_on_can)
    cans = both(SHAPES["cylinder"], SHAPES["cylinder"]).pair_names
    assert {"a[left] ~ b[left]", "a[in] ~ b[axis]", "b[in] ~ a[axis]"} < set(cans)
    assert "a[x+-] ~ b[.y.]".replace("b[.y.]", "b[-y+]") in (
        both(SHAPES["box"], SHAPES["box"]).pair_names
    )


def test_edges_of_large_hulls_are_not_listed():
    angles = [math.pi * k / 6 for k in range(12)]
    drum = Convex([(math.cos(a), math.sin(a), z) for a in angles for z in (-1, 1)])
    assert len(drum.edges) == 36
    assert both(drum, SHAPES["box"]).n_pairs == 24 + 8 + 1  # 12 x 36 crossings are more than 400
    assert both(drum, SHAPES["capsule"]).n_pairs == 24 + 2 + 36
    assert both(drum, SHAPES["cylinder"]).n_pairs == 24 + 8 + 36 * 3 + 2


def test_radii_add_in_the_curvature():
    gap = saltus.gap(Sphere(0.1), Pose((0.9, 0, 0)), Cylinder(0.3, 1.0), Pose())
    np.testing.assert_allclose(gap.F_W, np.diag([0, 1 / 0.9, 0]), atol=1e-14)
    assert gap.phi == pytest.approx(0.5)


@pytest.mark.slow
def test_pictures_of_pairs(tmp_path):
    pytest.importorskip("matplotlib")
    from saltus.plots import pairs as plots_pairs

    pairs = [
        (SHAPES[a], Pose((0, 0, 2)), SHAPES[b], Pose((0.1, 0, 0)))
        for b, a in (sorted(row, key="half_space".__ne__) for row in GAPS)
    ]
    sheet = plots_pairs.plot_gaps(pairs, tmp_path / "all.png")
    assert len(sheet.axes) == 28
    assert [axes.get_title() for axes in sheet.axes[:2]] == ["box ~ box", "capsule ~ box"]
    figure = plots_pairs.plot_gap(pairs[0], tmp_path / "one.svg")
    assert (tmp_path / "one.svg").stat().st_size > 1000
    # the witness points are drawn at the ends of a gap of 2 - 2 * 0.4, seen from above the horizon
    line = figure.axes[0].lines[0].get_xydata()
    length = np.linalg.norm(line[1] - line[0])
    assert length == pytest.approx(1.2 * math.cos(plots_pairs.ELEVATION))


@pytest.mark.parametrize("kind", [kind for kind in SHAPES if kind != "half_space"])
def test_facets_close_and_look_outwards(kind):
    from saltus.plots import pairs as plots_pairs

    facets = plots_pairs.facets_of(SHAPES[kind])
    normals = plots_pairs._normals(facets)
    for corners, n in zip(facets, normals, strict=True):
        assert n @ corners.mean(axis=0) > 0 or not n.any()
    # area vectors of a closed surface add up to 0
    areas = [np.cross(c, np.roll(c, -1, axis=0)).sum(axis=0) for c in facets]
    np.testing.assert_allclose(np.sum(areas, axis=0), 0, atol=1e-12)


def test_the_sheet_of_the_manual_is_small():
    assert 50_000 < (ROOT / "python" / "docs" / "pairs.png").stat().st_size < 600_000
