"""All files of example-robot-data: which load, which are refused and why, and the ways out."""

from __future__ import annotations

import pytest
from robot_files import robots_folder

import saltus

# What is wrong with files of example-robot-data, and which option reads them all the same.
REFUSED = {
    "romeo": ("moves no mass", {"inertia": "from_shapes"}),
    "romeo_laas_small": ("that no body can have", None),  # its gripper has no shape either
    "romeo_small": ("that no body can have", {"inertia": "as_given"}),
    "ur3": ("has no <link>", None),
}
# What is wrong and read with a warning.
FLAWED = {
    "alex_psyonic_hands": 'mimics joint "index_q1", which does not exist',
    "bolt": "has an inertia but no mass",
}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::saltus.ModelWarning")
def test_every_robot_loads_with_its_meshes():
    folder = robots_folder()
    paths = sorted(folder.rglob("*.urdf"))
    assert len(paths) > 60
    for path in paths:
        options = {"package_dirs": [folder, folder.parent], "visuals": False}
        if path.stem in REFUSED:
            words, way_out = REFUSED[path.stem]
            with pytest.raises(saltus.ModelError, match=words):
                saltus.load_urdf(path, **options)
            if way_out is None:
                continue
            options |= way_out
        model = saltus.load_urdf(path, **options)
        if path.stem in FLAWED:
            assert any(FLAWED[path.stem] in text for text in model.warnings)
