"""Arrays as text for the page: little-endian, bytes shuffled, deflated, base64."""

from __future__ import annotations

import base64
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

LONG = 1_000_000  # bytes; the last 5 % of longer ones would take eight times as long
KINDS = {"f4": "<f4", "f8": "<f8", "i4": "<i4"}


def packed(array: npt.ArrayLike, kind: str = "f4") -> dict[str, Any]:
    """Return an array as a JSON object that `decode.js` unpacks.

    Bytes of equal weight stand together: neighbours in time have equal exponents, which deflate
    makes short.

    Parameters
    ----------
    array : array_like
    kind : {"f4", "f8", "i4"}
        How a number is stored.

    Returns
    -------
    dict
        "kind", "shape", and "data" as base64 text.
    """
    numbers = np.ascontiguousarray(array, KINDS[kind])
    planes = numbers.reshape(-1).view(np.uint8).reshape(-1, numbers.itemsize).T
    return {"kind": kind, "shape": list(numbers.shape), "data": deflated(planes.tobytes())}


def unpacked(stored: dict[str, Any]) -> npt.NDArray[Any]:
    """Return the array that `packed` stored; for tests and for programs that read a page."""
    kind = np.dtype(KINDS[stored["kind"]])
    raw = np.frombuffer(zlib.decompress(base64.b64decode(stored["data"])), np.uint8)
    numbers: npt.NDArray[Any] = np.ascontiguousarray(raw.reshape(kind.itemsize, -1).T).view(kind)
    shaped: npt.NDArray[Any] = numbers.reshape(stored["shape"])
    return shaped


def deflated(data: bytes) -> str:
    """Return bytes as base64 text of their zlib stream."""
    level = 9 if len(data) < LONG else 6
    return base64.b64encode(zlib.compress(data, level)).decode("ascii")
