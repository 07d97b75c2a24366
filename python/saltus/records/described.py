"""A model in an HDF5 file: what it was built of, as a JSON document beside arrays.

The document is `Model._description`. Each array in it is replaced by `{"array": i}`, the dataset
`arrays/i` of the same group, and infinite numbers by "inf" and "-inf".
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from saltus._core import _DESCRIPTION_VERSION, Model, ModelError, __version__
from saltus.records.stored import Stored

if TYPE_CHECKING:
    import h5py

GROUP = "description"
DOCUMENT = f"{GROUP}/document"
SMALL = 1000  # bytes of an array that is not compressed

INFINITE = {"inf": math.inf, "-inf": -math.inf}
Arrays = dict[tuple[str, tuple[int, ...], bytes], tuple[int, npt.NDArray[Any]]]

# What of a description has no part in the motion: models that differ in it alone have one run.
# Which pairs the rules leave is told by the names of the pairs.
UNMOVED = {"name", "source", "solver", "visuals", "filter", "states", "sensors", "warnings"}


def write_model(file: h5py.File, model: Model, *, visuals: bool) -> None:
    """Write a model into a file; without visuals it is smaller."""
    import json

    import h5py

    description = model._description()
    source = description.pop("source")
    if not visuals:
        description["visuals"] = []
    arrays: Arrays = {}
    document = json.dumps(_encoded(description, arrays), allow_nan=False)
    group = file.create_group(GROUP)
    group.attrs.update(version=_DESCRIPTION_VERSION, collisions=model.n_pairs > 0)
    group.create_dataset("document", data=document, dtype=h5py.string_dtype())
    for i, array in arrays.values():
        options = {"compression": "gzip", "shuffle": True} if array.nbytes > SMALL else {}
        group.create_dataset(f"arrays/{i}", data=array, **options)
    if source:
        file.create_dataset("urdf", data=source, dtype=h5py.string_dtype())


def read_description(file: Stored) -> dict[str, Any]:
    """Return the plain data of a file's model."""
    import json

    version = _version(file)
    if version > _DESCRIPTION_VERSION:
        raise ModelError(
            f"{file.path} holds a model of version {version}; this saltus {__version__} reads up "
            f"to {_DESCRIPTION_VERSION}"
        )
    try:
        document = json.loads(file.text(DOCUMENT))
    except ValueError as error:
        file.fail(f'dataset "{DOCUMENT}"', f"is no JSON: {error}")
    if not isinstance(document, dict):
        file.fail(f'dataset "{DOCUMENT}"', "is no JSON object")
    description: dict[str, Any] = _decoded(document, file)
    description["source"] = file.text("urdf") if "urdf" in file else ""
    return description


def read_model(file: Stored, description: dict[str, Any]) -> Model:
    """Build the model of a description."""
    collisions = file.file[GROUP].attrs.get("collisions", True)
    try:
        return Model._of_description(
            description, collisions=bool(collisions), version=_version(file)
        )
    except ModelError as error:
        file.fail(f'dataset "{DOCUMENT}"', f"describes no model: {error}")


def _version(file: Stored) -> int:
    import h5py

    group = file.file[GROUP]
    if not isinstance(group, h5py.Group):
        file.fail(f'group "{GROUP}"', "is a dataset")
    version = group.attrs.get("version")
    if not isinstance(version, np.integer | int) or version < 1:
        file.fail(f'attribute "version" of "{GROUP}"', f"is {version!r}; it is 1 or more")
    return int(version)


def _encoded(x: Any, arrays: Arrays) -> Any:
    if isinstance(x, dict):
        return {name: _encoded(value, arrays) for name, value in x.items()}
    if isinstance(x, list):
        return [_encoded(value, arrays) for value in x]
    if isinstance(x, float) and math.isinf(x):
        return "inf" if x > 0 else "-inf"
    if isinstance(x, np.ndarray):  # meshes are often there twice, to touch and to see
        key = (x.dtype.str, x.shape, x.tobytes())
        return {"array": arrays.setdefault(key, (len(arrays), x))[0]}
    return x


def _decoded(x: Any, file: Stored) -> Any:
    if isinstance(x, dict):
        if x.keys() == {"array"}:
            return np.asarray(file.dataset(f"{GROUP}/arrays/{x['array']}"))
        return {name: _decoded(value, file) for name, value in x.items()}
    if isinstance(x, list):
        return [_decoded(value, file) for value in x]
    return x


def difference(ours: dict[str, Any], others: dict[str, Any]) -> str:
    """Return what of two descriptions makes their motions differ, "" where nothing does."""
    for name in {**ours, **others}:
        if name in UNMOVED:
            continue
        found = _difference(ours.get(name), others.get(name), name)
        if found:
            return found
    return ""


def _difference(a: Any, b: Any, where: str) -> str:
    if isinstance(a, dict) and isinstance(b, dict):
        names = [name for name in {**a, **b} if name != "check"]  # how it was judged
        parts = ((a.get(name), b.get(name), f"{where} {name}") for name in names)
        return next((found for part in parts if (found := _difference(*part))), "")
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        pairs = enumerate(zip(a, b, strict=True))
        parts = ((x, y, _label(where, x, i)) for i, (x, y) in pairs)
        return next((found for part in parts if (found := _difference(*part))), "")
    if _same(a, b):
        return ""
    return f"{where}: {_shown(a)} in the file, {_shown(b)} in the model"


def _label(where: str, item: Any, index: int) -> str:
    named = isinstance(item, dict) and item.get("name")
    return f'{where.removesuffix("s")} "{item["name"]}"' if named else f"{where}[{index}]"


def _same(a: Any, b: Any) -> bool:
    """Return whether values are equal; numbers to the rounding of another way to compute them."""
    a, b = (INFINITE.get(x, x) if isinstance(x, str) else x for x in (a, b))
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-14)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.shape == b.shape and bool(np.allclose(a, b, rtol=1e-9, atol=1e-14))
    return type(a) is type(b) and bool(a == b)


def _shown(x: Any) -> str:
    if isinstance(x, np.ndarray):
        return f"an array of shape {x.shape}"
    if isinstance(x, list | dict):
        return f"{len(x)} of them" if x else "none"
    return "none" if x is None else str(x)
