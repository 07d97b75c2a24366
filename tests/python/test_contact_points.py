"""Where contacts are, which way they push, and that this is all that changes a body's momentum."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import add_in_the_plane, puck, two_bodies

import saltus

G, H = 9.81, 0.01


def flat_box(builder: saltus.ModelBuilder) -> saltus.ModelBuilder:
    """Add a box of 2 kg that moves in x and z and turns about y."""
    return add_in_the_plane(builder, "box", saltus.Box((0.3, 0.2, 0.1)), 2.0)


def moments(run: saltus.Trajectory) -> np.ndarray:
    """Return momentum along x and z and angular momentum about the world's y axis, row by row."""
    x, z = run.q[:, 0], run.q[:, 1]
    p_x, p_z, p_turn = run.p.T
    return np.stack([p_x, p_z, p_turn + z * p_x - x * p_z], axis=1)


def of_contacts(run: saltus.Trajectory) -> np.ndarray:
    """Return what the contacts of each row add to these; the box is the first of every pair."""
    assert all(name.startswith("box") for name in run.pair_names)
    c = run.contacts
    force = c["lambda"][:, None] * c["normal"] + c["tangential"]
    moment = np.cross(c["point"], force)
    out = np.zeros((len(run), 3))
    np.add.at(out, c["row"], np.stack([force[:, 0], force[:, 2], moment[:, 1]], axis=1))
    return out


def of_weight(run: saltus.Trajectory, mass: float) -> np.ndarray:
    """Return what gravity adds to them in steps without impacts, which are straight in x."""
    x = run.q[:, 0]
    force = np.full(len(run) - 1, -mass * G * H)
    return np.stack([np.zeros(len(force)), force, -(x[1:] + x[:-1]) / 2 * force], axis=1)


@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize("restitution", [1.0, 0.6])
def test_impacts_in_a_room_are_all_that_changes_the_momenta(friction, restitution):
    builder = saltus.ModelBuilder("room").set_gravity((0, 0, 0))
    flat_box(builder).add_half_space("floor", (0, 0, 1), -1).add_half_space("top", (0, 0, -1), -1)
    builder.add_half_space("left", (1, 0, 0), -1).add_half_space("right", (-1, 0, 0), -1)
    model = builder.set_default_contact(restitution=restitution, friction=friction).build()
    start = {"x": 1.3, "z": -1.7, "turn": 5.0}
    run = saltus.simulate(model, v=start, duration=8.0, h=H, record_contacts=True)
    assert len(run.impacts) > 5
    change = np.diff(moments(run), axis=0)
    np.testing.assert_allclose(of_contacts(run)[1:], change, atol=1e-12)  # of momenta near 5
    np.testing.assert_array_equal(run.contacts["t"], run.impacts["t"][run.contacts["impact"]])


def test_what_holds_a_box_that_slides_to_rest_balances_it_step_by_step():
    builder = flat_box(saltus.ModelBuilder("floor")).add_half_space("floor", (0, 0, 1), -0.1)
    model = builder.set_default_contact(restitution=0, friction=0.3).build()
    run = saltus.simulate(model, v={"x": 1.0}, duration=0.6, h=H, record_contacts=True)
    assert abs(run.v[-1]).max() < 1e-12
    assert run.v[20, 0] > 0.3  # slides for 1 / (0.3 g) = 0.34 s
    assert (run.contacts["impact"] == -1).all()
    change = np.diff(moments(run), axis=0) - of_weight(run, 2.0)
    np.testing.assert_allclose(of_contacts(run)[1:], change, atol=1e-12)
    # ends in the middle of the step, where it comes to rest, and of the way of every other
    middle = (run.q[1:, 0] + run.q[:-1, 0]) / 2
    for row in (1, 20, 60):
        held = run.contacts[run.contacts["row"] == row]
        assert set(np.round(held["point"][:, 0] - middle[row - 1], 12)) == {-0.3, 0.3}


def test_a_box_at_rest_stands_on_its_corners():
    half = np.array([0.3, 0.2, 0.1])
    at = np.array([1.0, -2.0, 0.1])
    builder = saltus.ModelBuilder("box").add_half_space("floor", (0, 0, 1))
    builder.add_body("box", saltus.Box(half), mass=2.0, X=saltus.Pose(at))
    model = builder.set_default_contact(restitution=0, friction=0.5).build()
    stepper = saltus.Stepper(model, h=H)
    stepper.advance(model.state())
    feet = stepper.report.contacts
    corners = {(x, y, 0.0) for x in (0.7, 1.3) for y in (-2.2, -1.8)}
    assert {tuple(np.round(foot.point, 12) + 0.0) for foot in feet} == corners
    for foot in feet:
        np.testing.assert_array_equal(foot.normal, [0, 0, 1])
    assert sum(foot.impulse for foot in feet) == pytest.approx(2.0 * G * H, abs=1e-12)
    middle = sum(foot.impulse * foot.point for foot in feet)  # of what bears it: below the centre
    np.testing.assert_allclose(middle, 2.0 * G * H * np.array([1.0, -2.0, 0.0]), atol=1e-12)


def test_a_ball_touches_a_slope_below_its_centre():
    a, r = 0.3, 0.1
    up = np.array([np.sin(a), 0, np.cos(a)])
    builder = add_in_the_plane(saltus.ModelBuilder("ball"), "ball", saltus.Sphere(r), 1.0)
    builder.add_half_space("slope", up).set_default_contact(restitution=0, friction=0.5)
    model = builder.build()
    start = model.state({"x": r * up[0], "z": r * up[2]})
    run = saltus.simulate(model, state=start, duration=0.5, h=H, record_contacts=True)
    c = run.contacts
    np.testing.assert_array_equal(c["row"], np.arange(1, 51))
    np.testing.assert_allclose(c["normal"], np.tile(up, (50, 1)), atol=1e-15)
    np.testing.assert_allclose(c["t"], run.t[1:], atol=0)
    # its impulses act at the start and the end of the step, in parts that the law chooses
    away = c["point"] + r * c["normal"]
    for k in range(50):
        first, last = run.q[k, :2], run.q[k + 1, :2]
        part = np.dot(away[k, [0, 2]] - first, last - first) / np.dot(last - first, last - first)
        assert -1e-9 <= part <= 1 + 1e-9
        np.testing.assert_allclose(away[k, [0, 2]], first + part * (last - first), atol=1e-12)
    np.testing.assert_allclose(c["lambda"], G * H * np.cos(a), atol=1e-12)
    np.testing.assert_allclose(c["tangential"] @ up, 0, atol=1e-15)


def test_two_balls_meet_on_the_line_of_their_centres():
    radii, at, there = (0.1, 0.25), np.array([-1, 0.05, 0.02]), np.array([0.4, -0.03, 0.1])
    one, other = (saltus.Sphere(radius) for radius in radii)
    model = two_bodies(one=one, other=other).set_gravity((0, 0, 0)).build()
    start = {"one": saltus.Pose(at), "other": saltus.Pose(there)}
    run = saltus.simulate(model, q=start, v={"one_vx": 2.0, "other_vy": 0.1}, duration=1.0, h=H)
    (impact,) = (run.impact(i) for i in range(len(run.impacts)))
    way = impact.t * np.array([[2.0, 0, 0], [0, 0.1, 0]])
    centres = at + way[0], there + way[1]
    along = (centres[0] - centres[1]) / np.linalg.norm(centres[0] - centres[1])
    assert impact.pairs == ["one ~ other"]
    np.testing.assert_allclose(impact.normals, [along], atol=1e-12)
    np.testing.assert_allclose(impact.points, [centres[1] + radii[1] * along], atol=1e-12)
    gained = run.p[-1] - run.p[0]
    push = impact.lambdas[0] * along  # on the first, and the opposite on the second
    np.testing.assert_allclose([gained[:3], gained[6:9]], [push, -push], atol=1e-12)


def test_edges_meet_where_they_cross():
    box = saltus.Box((0.5, 0.1, 0.1))
    down = np.sqrt(2) * 0.1
    on_edge = saltus.Pose.from_rpy(np.pi / 4, 0, 0)
    upper = saltus.Pose((0, 0, 2 * down + 0.3)) * on_edge
    lower = saltus.Pose.from_rpy(0, 0, np.pi / 2, p=(0.1, 0.2, 0)) * on_edge
    model = two_bodies(one=box, other=box).set_gravity((0, 0, 0)).build()
    for one, other, falls in ((upper, lower, "one"), (lower, upper, "other")):
        start = {"one": one, "other": other}
        run = saltus.simulate(model, q=start, v={f"{falls}_vz": -1.0}, duration=0.5, h=H)
        first = run.impact(0)
        assert first.t == pytest.approx(0.3, abs=1e-12)
        np.testing.assert_allclose(first.points, [[0.1, 0, down]], atol=1e-12)
        assert first.pairs[0].startswith("one[")  # so the normal is from other to one
        np.testing.assert_allclose(first.normals, [[0, 0, 1 if one is upper else -1]], atol=1e-12)


def toss(builder: saltus.ModelBuilder, **options) -> saltus.Trajectory:
    """Throw a box of 2 kg that turns about all axes into what the builder has."""
    builder.add_body("box", saltus.Box((0.3, 0.2, 0.1)), mass=2.0, joint_name="free")
    start = {"free": saltus.Pose.from_rpy(0.4, -0.3, 1.1, p=(0, 0, 1))}
    v = {"free": (2, 0.3, 1, 3, -4, 2)}
    return saltus.simulate(builder.build(), q=start, v=v, h=H, record_contacts=True, **options)


def six_momenta(run: saltus.Trajectory) -> np.ndarray:
    """Return momentum and angular momentum about the world's origin, row by row."""
    x, p = run.q[:, :3], run.p[:, :3]
    return np.hstack([p, run.p[:, 3:] + np.cross(x, p)])


def six_of_contacts(run: saltus.Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Return what the contacts of each row add to these, and the sum of their sizes."""
    assert all(run.pair_names[i].startswith("box") for i in run.contacts["pair"])
    c = run.contacts
    force = c["lambda"][:, None] * c["normal"] + c["tangential"]
    out, size = np.zeros((len(run), 6)), np.zeros(len(run))
    np.add.at(out, c["row"], np.hstack([force, np.cross(c["point"], force)]))
    np.add.at(size, c["row"], np.linalg.norm(force, axis=1))
    return out, size


@pytest.mark.parametrize(
    ("restitution", "friction", "law"),
    [
        (1.0, 0.0, saltus.ImpactLaw.nodal_energy),
        (1.0, 0.0, saltus.ImpactLaw.discrete_energy),
        (1.0, 0.0, saltus.ImpactLaw.shadow_energy),
        (0.8, 0.0, saltus.ImpactLaw.discrete_energy),
        (1.0, 0.4, saltus.ImpactLaw.nodal_energy),
        (0.6, 0.4, saltus.ImpactLaw.nodal_energy),
    ],
)
def test_impacts_in_a_closed_room_are_all_that_changes_all_six_momenta(restitution, friction, law):
    builder = saltus.ModelBuilder("room").set_gravity((0, 0, 0))
    for axis in np.eye(3):
        for side in (1, -1):
            offset = side * axis[2] - 0.6  # 0.6 m from the box's centre (0, 0, 1)
            builder.add_half_space(f"{'xyz'[axis.argmax()]}{side}", side * axis, offset)
    builder.set_default_contact(restitution=restitution, friction=friction)
    run = toss(builder, duration=4.0, law=law)
    assert len(run.impacts) > 5
    gained, _ = six_of_contacts(run)
    np.testing.assert_allclose(gained[1:], np.diff(six_momenta(run), axis=0), atol=1e-12)  # of 4


@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("restitution", [1.0, 0.7, 0.0])
def test_contacts_and_weight_are_all_that_changes_a_tossed_box(restitution, friction):
    builder = saltus.ModelBuilder("yard").add_half_space("floor", (0, 0, 1))
    builder.add_half_space("wall", (-1, 0, 0), -1.0)
    builder.set_default_contact(restitution=restitution, friction=friction)
    run = toss(builder, duration=3.0)
    assert len(run.impacts) > 5
    x, weight = run.q[:, :3], np.array([0, 0, -2.0 * G * H])
    middle = (x[1:] + x[:-1]) / 2
    of_weight = np.hstack([np.tile(weight, (len(middle), 1)), np.cross(middle, weight)])
    gained, size = six_of_contacts(run)
    error = np.abs(np.diff(six_momenta(run), axis=0) - of_weight - gained[1:])
    assert error[:, :3].max() < 1e-12  # of momenta near 7
    # Weight acts in the middle of every arc, not of a step that impacts make of several: a path
    # with a corner dv on a straight one's mean is at most h |dv| / 8 from it.
    moment = np.full((len(error), 3), 1e-12)
    impacts = np.searchsorted(run.t, run.impacts["t"] - 1e-12) - 1
    moment[impacts, :2] += 2.0 * G * H * H * (size[1:][impacts, None] / 2.0) / 8
    # The friction of a pair is told as a sum that acts in one point. Where the box spins, that
    # of its parts at both ends of a step, h v = 0.02 m apart, turns by h w = 0.05 rad.
    moment += friction * size[1:, None] * 0.02 * 0.05 / 4
    assert np.all(error[:, 3:] < moment)


def test_contacts_are_impulses_of_impacts_and_of_steps():
    model = puck(restitution=0.5, friction=0.2)
    start = {"q": {"z": 0.1}, "v": {"x": 2.0}, "duration": 1.5}
    run = saltus.simulate(model, **start, record_contacts=True)
    hits = run.contacts[run.contacts["impact"] >= 0]
    for name in run.impulses.dtype.names:
        np.testing.assert_array_equal(hits[name], run.impulses[name])
    held = run.contacts[run.contacts["impact"] < 0]
    assert len(held) > 20  # from when it has come to rest
    assert np.all(np.diff(run.contacts["row"]) >= 0)
    assert np.all(np.diff(run.contacts["t"]) >= 0)
    row = run.contacts["row"]
    assert np.all((run.t[row - 1] < run.contacts["t"]) & (run.contacts["t"] <= run.t[row]))
    with pytest.raises(ValueError, match="read-only"):
        run.contacts["t"][0] = 0
    few = saltus.simulate(model, **start, record_contacts=True, record_every=7)
    np.testing.assert_array_equal(few.contacts["row"], -(-row // 7))
    for name in set(run.contacts.dtype.names) - {"row"}:
        np.testing.assert_array_equal(few.contacts[name], run.contacts[name])


def test_contacts_come_on_request():
    run = saltus.simulate(puck(), q={"z": 0.1}, duration=0.1)
    with pytest.raises(saltus.ModelError, match=r"not recorded; .*record_contacts=True"):
        _ = run.contacts


def test_a_batch_has_the_contacts_of_its_runs():
    model = puck(restitution=0.5, friction=0.2)
    q, options = {"z": np.array([0.0, 0.1, 5.0])}, {"duration": 0.8, "record_every": 3}
    batch = saltus.simulate_batch(model, q=q, **options, record_contacts=True, progress=False)
    for z, run in zip(q["z"], batch, strict=True):
        alone = saltus.simulate(model, q={"z": z}, **options, record_contacts=True)
        assert run.contacts.tobytes() == alone.contacts.tobytes()
    assert len(batch[2].contacts) == 0
    with pytest.raises(saltus.ModelError, match="record_contacts=True"):
        _ = saltus.simulate_batch(model, q=q, **options, progress=False)[0].contacts
