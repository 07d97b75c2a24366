"""Friction, as a script or a URDF file asks for it."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import puck

import saltus

G = 9.81


def test_a_puck_stops_where_it_should():
    run = saltus.simulate(puck(restitution=0, friction=0.4), v={"x": 2.0}, duration=2.0, h=0.005)
    assert run.q[-1, 0] == pytest.approx(4 / (2 * 0.4 * G), abs=0.005**2 * 0.4 * G / 8 + 1e-12)
    assert np.abs(run.v[-1]).max() < 1e-14
    assert np.all(np.diff(run.total) <= 1e-12)
    assert len(run.impacts) == 0


def test_an_impact_takes_at_most_mu_times_its_normal_impulse():
    run = saltus.simulate(
        puck(restitution=0.5, friction=0.2), v={"x": 2.0, "z": -1.0}, duration=0.01
    )
    assert run.impulses["lambda"] == pytest.approx([1.5])
    assert run.v[-1, 0] == pytest.approx(2 - 0.2 * 1.5)


URDF = """<robot name="block"><link name="world"/>
<link name="block"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="x" type="prismatic"><parent link="world"/><child link="block"/><axis xyz="1 0 0"/>
<limit effort="1" velocity="1" lower="-9" upper="9"/></joint>
<saltus><half_space name="floor" normal="0 0 1" offset="-0.1"/>
<contact restitution="0" friction="{friction}"/></saltus></robot>"""


def test_a_urdf_file_says_how_rough():
    model = saltus.load_urdf(URDF.format(friction=0.3))
    assert model.contact_properties(0).friction == 0.3
