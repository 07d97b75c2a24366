"""Files as older versions wrote them."""

from __future__ import annotations

from pathlib import Path

import h5py


def as_version_2(path: Path) -> None:
    """Make a file what version 2 wrote: URDF text and options where there is a text."""
    with h5py.File(path, "r+") as file:
        del file["description"]
        file.attrs["version"] = 2
        if "urdf" in file:
            file.attrs.update(
                gravity=[0, 0, -9.81], root_joint="fixed", solver="automatic", meshes="none",
                floor=False, effects=15, inertia="checked",
            )  # fmt: skip
