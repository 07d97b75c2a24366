"""URDF of a pendulum, to be spoilt in one place, and what loading it says."""

from __future__ import annotations

import pytest

import saltus

BALL = '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'


def inertial(mass: float = 1, moments: str = BALL, origin: str = '<origin xyz="0 0 -0.5"/>') -> str:
    return f'<inertial>{origin}<mass value="{mass}"/>{moments}</inertial>'


def diagonal(*moments: float) -> str:
    x, y, z = moments
    return f'<inertia ixx="{x}" ixy="0" ixz="0" iyy="{y}" iyz="0" izz="{z}"/>'


def arm(base: str = "", body: str = "", joint: str = "", kind: str = "continuous", more="") -> str:
    """Return a pendulum, each part in a line of its own."""
    return (
        f'<robot name="arm">\n<link name="base">{base}</link>\n'
        f'<link name="arm">{body or inertial()}</link>\n'
        f'<joint name="j" type="{kind}"><parent link="base"/><child link="arm"/>'
        f'<axis xyz="0 1 0"/>{joint}</joint>\n{more}</robot>'
    )


def flawed(text: str, *words: str, **options) -> saltus.Model:
    """Load with one warning that has these words; strict, it is an error with the first of them."""
    with pytest.warns(saltus.ModelWarning) as caught:
        model = saltus.load_urdf(text, **options)
    found = [str(each.message) for each in caught]
    assert len(found) == 1, found
    for word in words:
        assert word in found[0]
    with pytest.raises(saltus.ModelError) as error:
        saltus.load_urdf(text, strict=True, **options)
    assert words[0] in str(error.value)
    return model


def sound(text: str, **options) -> saltus.Model:
    """Load strictly, and without a warning."""
    builder = saltus.read_urdf(text, strict=True, **options)
    assert builder.warnings == []
    return builder.build()


def collision(shape: str, origin: str = '<origin xyz="0 0 -1"/>') -> str:
    return f"<collision>{origin}<geometry>{shape}</geometry></collision>"


def swing(model: saltus.Model) -> float:
    return float(model.mass_matrix(None)[0, 0])
