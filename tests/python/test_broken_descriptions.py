"""Models in files that are ruined: a ModelError with the place and the reason."""

from __future__ import annotations

import json

import h5py
import numpy as np
import pytest
from test_described import driven_arm
from test_pickle import everything

import saltus

DOCUMENT = "description/document"


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "run.h5"
    saltus.simulate(everything(), duration=0.01, progress=False).save(path)
    return path.read_bytes()


@pytest.fixture
def path(tmp_path, whole):
    (tmp_path / "run.h5").write_bytes(whole)
    return tmp_path / "run.h5"


def rewrite(path, change) -> None:
    """Change the document of a file, and write what `change` returns or leaves."""
    with h5py.File(path, "r+") as file:
        document = json.loads(file[DOCUMENT].asstr()[()])
        changed = change(document)
        del file[DOCUMENT]
        file[DOCUMENT] = changed if isinstance(changed, str) else json.dumps(document)


def at(*place, value):
    def change(document) -> None:
        *inner, last = place
        for each in inner:
            document = document[each]
        document[last] = value

    return change


def without(*place):
    def change(document) -> None:
        *inner, last = place
        for each in inner:
            document = document[each]
        del document[last]

    return change


RUINED = [
    (lambda d: "{", 'dataset "description/document" is no JSON'),
    (lambda d: "[1, 2]", 'dataset "description/document" is no JSON object'),
    (lambda d: "[" * 100_000, "is no JSON|no trajectory that saltus can read"),
    (at("links", value=3), "links is 3; it is a list"),
    (at("links", value=[]), "first link"),
    (
        at("links", 1, "inertia", "mass", value="heavy"),
        r"links\[1\].inertia.mass is 'heavy'; it is",
    ),
    (at("links", 1, "inertia", "mass", value=float("nan")), r"links\[1\].inertia.mass is nan"),
    (at("links", 1, "inertia", "mass", value=-1.0), 'link "body_0" has mass -1'),
    (at("links", 1, "inertia", "mass", value=True), r"inertia.mass is True; it is a number"),
    (
        at("links", 1, "inertia", "mass", value=10**400),
        r"inertia.mass is 1000.*a number that a dou",
    ),
    (at("links", 1, "inertia", "mass", value="inf"), "body_0"),
    (at("links", 1, "name", value=7), r"links\[1\].name is 7; it is a text"),
    (at("links", 2, "name", value="body_0"), 'two links are named "body_0"'),
    (at("links", 1, "colour", value=7), r'links\[1\] has "colour", which is not known'),
    (
        at("links", 1, "check", value="maybe"),
        r'links\[1\].check is "maybe"; there are strict, leni',
    ),
    (without("links", 1, "inertia"), r'links\[1\] has no "inertia"'),
    (without("gravity"), 'has no "gravity"'),
    (at("gravity", value=[0, 0]), r"gravity has 2 entries; it has 3"),
    (at("joints", 0, "parent", value="nobody"), '"nobody", which does not exist'),
    (at("joints", 0, "type", value="magic"), r'joints\[0\].type is "magic"; there are fixed'),
    (
        at("joints", 0, "effects", value=["magic"]),
        r'joints\[0\].effects has "magic"; there are lim',
    ),
    (at("joints", 0, "X_PJ", "R", 0, value=[2, 0, 0]), "placement that is no rotation"),
    (
        at("shapes", 0, "shape", "kind", value="blob"),
        r'shapes\[0\].shape.kind is "blob"; there are',
    ),
    (at("shapes", 0, "shape", "radius", value=-1), "sphere"),
    (at("shapes", 5, "shape", "center", value=[0, 0]), r"shapes\[5\].shape.center has 2 entries"),
    (
        at("shapes", 5, "shape", "vertices", value=[1]),
        r"shape.vertices is \[1\]; it is an array of",
    ),
    (at("shapes", 5, "shape", "vertices", "array", value=99), 'dataset "description/arrays/99" is'),
    (
        at("shapes", 5, "shape", "vertices", "array", value="../t"),
        r"description/arrays|vertices is",
    ),
    (
        at("shapes", 5, "shape", "edges", "array", value=0),
        r"edges is an array of float64, shape .*; it is",
    ),
    (
        at("materials", "of_link", value=[["a", "b"], ["a", "c"]]),
        "materials.of_link has an entry tw",
    ),
    (at("solver", value=None), "solver is None; it is a text"),
]


@pytest.mark.parametrize("ruined", RUINED, ids=[words for _, words in RUINED])
def test_what_is_wrong_is_named(path, ruined):
    change, words = ruined
    rewrite(path, change)
    with pytest.raises(saltus.ModelError, match=words) as error:
        saltus.load(path)
    assert "run.h5" in str(error.value)


def test_arrays_of_other_types_and_numbers(path):
    """Indices of a hull's corners and edges may be anything: nothing is read beyond its ends."""
    data = path.read_bytes()
    with h5py.File(path) as file:
        names = [*file["description/arrays"]]
    values = [3.0, "text", np.zeros(3), np.zeros((0, 3)), np.full((7, 3), np.nan)]
    for name in names:
        for value in [*values, "minus", "great", "huge", "short"]:
            path.write_bytes(data)
            with h5py.File(path, "r+") as file:
                place = f"description/arrays/{name}"
                old = file[place][()]
                new = {
                    "minus": lambda x: -x - 1,
                    "great": lambda x: x + 10**6,
                    "huge": lambda x: x.astype(np.int64) + 2**40 if x.dtype.kind == "i" else x * 9,
                    "short": lambda x: x[:-1],
                }.get(str(value) if isinstance(value, str) else "", lambda _, v=value: v)(old)
                del file[place]
                file[place] = new
            with pytest.raises(saltus.ModelError, match=r"run\.h5"):
                saltus.load(path)


def places(value, place=()):
    """Yield the places of all values of a document."""
    yield place
    if isinstance(value, dict):
        for name, each in value.items():
            yield from places(each, (*place, name))
    elif isinstance(value, list):
        for i, each in enumerate(value[:2]):
            yield from places(each, (*place, i))


def outcome(path) -> str:
    """Return what loading says, or that there is a model."""
    try:
        return "no model" if saltus.load(path).model is None else "a model"
    except saltus.ModelError as error:
        return str(error)


def test_any_value_may_be_another(tmp_path):
    """Every value in turn becomes each of these: an error with its file, or a model."""
    path = tmp_path / "run.h5"
    saltus.simulate(driven_arm().build(), duration=0.01, progress=False).save(path)
    with h5py.File(path) as file:
        text = file[DOCUMENT].asstr()[()]
    rng = np.random.default_rng(5)
    refused = 0
    everywhere = [place for place in places(json.loads(text)) if place]
    values = [None, True, -1, 1e300, float("nan"), "", "x", [], {}, [[]], {"array": 0}]
    with h5py.File(path, "r+") as file:
        del file[DOCUMENT]
        file.create_dataset(DOCUMENT, data="", dtype=h5py.string_dtype())
    for place in everywhere:
        for index in rng.choice(len(values), 3, replace=False):
            document = json.loads(text)
            at(*place, value=values[index])(document)
            with h5py.File(path, "r+") as file:
                file[DOCUMENT][()] = json.dumps(document)
            said = outcome(path)
            assert said == "a model" or "run.h5" in said
            refused += said != "a model"
    assert refused > 2 * len(everywhere)
