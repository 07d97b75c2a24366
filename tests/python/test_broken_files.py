"""HDF5 files of wrong types, shapes and indices: a ModelError that names the part and says why."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from old_files import as_version_2
from scenes import cradle_run

import saltus


@pytest.fixture
def path(tmp_path):
    cradle_run().save(tmp_path / "run.h5")
    return tmp_path / "run.h5"


def attribute(name: str, value: object):
    def ruin(file: h5py.File) -> None:
        file.attrs[name] = value

    return ruin


def without_attribute(name: str):
    def ruin(file: h5py.File) -> None:
        del file.attrs[name]

    return ruin


def dataset(name: str, value: object):
    def ruin(file: h5py.File) -> None:
        del file[name]
        if value is not None:
            file[name] = value

    return ruin


def row(name: str, index: int, value: float):
    """Return what writes a value in a row of an array."""

    def ruin(file: h5py.File) -> None:
        file[name][index] = value

    return ruin


def column(table: str, name: str, value: object):
    def ruin(file: h5py.File) -> None:
        rows = file[table][()]
        rows[name] = value
        file[table][...] = rows

    return ruin


def without_column(table: str, name: str):
    def ruin(file: h5py.File) -> None:
        rows = file[table][()]
        del file[table]
        file[table] = rows[[each for each in rows.dtype.names if each != name]]

    return ruin


def group(name: str):
    def ruin(file: h5py.File) -> None:
        del file[name]
        file.create_group(name)

    return ruin


TEXTS = h5py.string_dtype()
RUINED = [
    (attribute("version", "1"), "attribute \"version\" is '1', which is no number"),
    (attribute("version", [1, 2]), r'attribute "version" has shape \(2,\)'),
    (without_attribute("version"), 'attribute "version" is not there'),
    (attribute("h", "x"), "attribute \"h\" is 'x', which is no number"),
    (attribute("h", -1.0), 'attribute "h" is -1.0; a step is above 0'),
    (attribute("max_impacts", 1.5), "no trajectory that saltus can read"),
    (attribute("law", [1, 2]), r'attribute "law" has shape \(2,\)'),
    (attribute("law", "magic"), "attribute \"law\" is 'magic'; there are nodal_energy"),
    (attribute("order", 7), 'attribute "order" is 7; there are'),
    (attribute("residual", np.zeros(2)), r'attribute "residual" has shape \(2,\)'),
    (attribute("format", np.zeros(2)), 'attribute "format" has shape'),
    (attribute("format", 3), "holds no trajectory of saltus"),
    (dataset("q", 5.0), r'dataset "q" has shape \(\); it must be \(\d+, 6\)'),
    (dataset("q", np.zeros((3, 6))), r'dataset "q" has shape \(3, 6\)'),
    (dataset("q", None), 'dataset "q" is not there'),
    (group("q"), 'dataset "q" is a group'),
    (dataset("t", np.zeros(0)), 'dataset "t" has no rows'),
    (row("q", 3, np.nan), r'dataset "q" has in row 3 what is not finite: \[nan '),
    (row("p", 2, np.inf), r'dataset "p" has in row 2 what is not finite: \[inf '),
    (row("t", 1, np.nan), 'dataset "t" has in row 1 what is not finite: nan'),
    (row("t", 4, 0.001), 'dataset "t" goes back in time after row 3'),
    (dataset("t", np.zeros((3, 3))), r'dataset "t" has shape \(3, 3\); it must be \(any\)'),
    (dataset("kinetic", np.array([b"x", b"y"])), 'dataset "kinetic" has shape'),
    (dataset("coordinate_names", 3.0), 'dataset "coordinate_names" is float64'),
    (dataset("coordinate_names", np.zeros(6)), 'dataset "coordinate_names" is float64'),
    (dataset("pair_names", np.array(["a"], TEXTS)), "has a row|there is|the model has"),
    (dataset("impacts", np.zeros(3)), 'dataset "impacts" is float64 of shape .3,., no table'),
    (without_column("impacts", "first"), 'dataset "impacts" has no column "first"'),
    (without_column("impulses", "pair"), 'dataset "impulses" has no column "pair"'),
    (column("impulses", "pair", 10**6), '1000000 in column "pair" of row 0; there is 0 to 2'),
    (column("impulses", "pair", -1), '-1 in column "pair" of row 0; there is 0 to 2'),
    (column("impulses", "impact", 10**9), 'has 1000000000 in column "impact"'),
    (column("impacts", "first", -5), 'has -5 in column "first"'),
    (column("impacts", "count", 10**6), 'has 1000000 in column "count"'),
    (column("impacts", "first", 2**63 - 1), 'in column "first" of row 0'),
    (column("impacts", "law", 200), 'has 200 in column "law"'),
    (dataset("certificates", np.array(["a"], TEXTS)), 'dataset "certificates" has not as many'),
    (dataset("urdf", 3.0), 'dataset "urdf" is no text'),
    (dataset("description", 3.0), 'group "description" is a dataset'),
    (dataset("description/document", 3.0), 'dataset "description/document" is no text'),
    (group("description/document"), 'dataset "description/document" is a group'),
]
OLD_RUINED = [
    (attribute("root_joint", "magic"), "attribute \"root_joint\" is 'magic'; there are fixed"),
    (attribute("gravity", "down"), "no trajectory that saltus can read"),
    (attribute("gravity", [1.0, 2.0]), "no trajectory that saltus can read"),
    (dataset("urdf", 3.0), 'dataset "urdf" is no text'),
    (dataset("urdf", "no URDF"), "no file|no trajectory"),
    (dataset("urdf", "<robot/>"), "no <link>"),
]


@pytest.mark.parametrize("ruined", RUINED, ids=[words for _, words in RUINED])
def test_what_is_wrong_is_named(path, ruined):
    ruin, words = ruined
    with h5py.File(path, "r+") as file:
        ruin(file)
    with pytest.raises(saltus.ModelError, match=words):
        saltus.load(path)


@pytest.mark.parametrize("ruined", OLD_RUINED, ids=[words for _, words in OLD_RUINED])
def test_what_is_wrong_in_an_older_file_is_named(path, ruined):
    as_version_2(path)
    test_what_is_wrong_is_named(path, ruined)


def test_a_table_of_other_types(path):
    with h5py.File(path, "r+") as file:
        old = file["impulses"][()]
        kinds = [(n, "S8" if n == "lambda" else old.dtype[n]) for n in old.dtype.names]
        del file["impulses"]
        file["impulses"] = np.zeros(len(old), kinds)
    with pytest.raises(saltus.ModelError, match='"impulses" has a column "lambda" of type'):
        saltus.load(path)


def test_any_part_may_be_cut_off(path):
    """Whatever bytes are left, there is an error in words or a run, and no crash."""
    data = path.read_bytes()
    for size in range(0, len(data), max(1, len(data) // 60)):
        path.write_bytes(data[:size])
        with pytest.raises(saltus.ModelError, match=r"run\.h5"):
            saltus.load(path)


# What files of older versions have not.
OLDER = {
    "velocity_names", "certificates", "settlings", "fallbacks", "urdf", "@saltus_version", "@model",
    "@order", "@certify", "@solver", "@meshes", "@floor", "@inertia", "@max_halvings", "@strict",
    "@max_impulses", "@max_iterations", "@max_impacts", "@rest", "@simultaneous", "@h",
    "@collisions", "@effects", "control", "work", "control_names", "description",
}  # fmt: skip


def test_any_part_may_be_missing(path):
    data = path.read_bytes()
    with h5py.File(path) as file:
        names = [*file, *(f"@{name}" for name in file.attrs)]
    for name in names:
        path.write_bytes(data)
        with h5py.File(path, "r+") as file:
            if name.startswith("@"):
                del file.attrs[name[1:]]
            else:
                del file[name]
        if name in OLDER:
            run = saltus.load(path)
            assert run.impact(0).pairs == cradle_run().impact(0).pairs
        else:
            with pytest.raises(saltus.ModelError, match=rf"run\.h5.*({name.strip('@')}|no traj)"):
                saltus.load(path)


@pytest.mark.parametrize("index", [10**9, -(10**9), 2**63])
def test_rows_that_are_not_there(index):
    for call in (cradle_run().state, cradle_run().impact):
        with pytest.raises(IndexError, match=rf"no \w+ {index}; the run has"):
            call(index)


def test_rows_that_are_no_numbers():
    for call in (cradle_run().state, cradle_run().impact):
        with pytest.raises(TypeError, match="= 'x' is no whole number"):
            call("x")
