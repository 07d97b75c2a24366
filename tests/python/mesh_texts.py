"""Mesh files as texts: a tetrahedron, and COLLADA with any nodes."""

from __future__ import annotations

import numpy as np

TETRAHEDRON = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def obj(vertices=TETRAHEDRON, faces=FACES) -> str:
    lines = [f"v {x} {y} {z}" for x, y, z in np.asarray(vertices).tolist()]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in np.asarray(faces).tolist()]
    return "\n".join(lines) + "\n"


def dae(scene: str, vertices=TETRAHEDRON, faces=FACES, asset: str = "", more: str = "") -> str:
    """Return COLLADA with geometry `#g` and these elements in its scene."""
    points = " ".join(str(x) for x in np.asarray(vertices).ravel().tolist())
    corners = " ".join(str(i) for i in np.asarray(faces).ravel().tolist())
    n = len(vertices)
    names = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>{asset}</asset>
{more}<library_geometries><geometry id="g"><mesh><source id="s">
<float_array id="a" count="{3 * n}">{points}</float_array>
<technique_common><accessor source="#a" count="{n}" stride="3">{names}</accessor></technique_common>
</source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="{len(faces)}" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>{corners}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w">{scene}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>
"""
