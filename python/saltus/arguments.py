"""Error messages for wrong arguments of the compiled part.

The compiled part calls `explain` instead of pybind11, which would print C++-like signatures. The
expected types are read from the signature that pybind11 gives.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from saltus import _core

LONGEST = 60  # letters of a value that are shown

NUMERIC = ("typing.SupportsFloat", "typing.SupportsInt")
FIXED = re.compile(r'"FixedSize\((\d+)\)"')
NUMBERS = {"SupportsFloat": "number", "SupportsInt": "whole number"}


class Parameter(NamedTuple):
    """A parameter of a signature: its annotation as text, and whether it may be left out."""

    name: str
    annotation: str
    optional: bool


class Signature(NamedTuple):
    """A function as pybind11 describes it: `positional` is how many need no keyword."""

    name: str
    parameters: list[Parameter]
    positional: int


def explain(
    message: str, positional: Sequence[object], keywords: Mapping[str, object]
) -> str | None:
    """Return what is wrong with a call.

    Parameters
    ----------
    message : str
        What pybind11 says of it.
    positional : sequence
        The arguments, `self` first where there is one.
    keywords : mapping

    Returns
    -------
    str or None
        None where the message is another, or names several signatures.
    """
    lines = message.splitlines()
    signatures = [line.partition(". ")[2] for line in lines if re.match(r" {4}\d+\. ", line)]
    if " arguments. The following" not in lines[0] or len(signatures) != 1:
        return None
    makes = "incompatible constructor" in lines[0]
    signature = _signature(signatures[0], lines[0].partition("(")[0])
    given = positional[1:] if makes else positional
    return f"{signature.name}() {_complaint(signature, given, keywords)}"


def find_truth_value(
    document: str, positional: Sequence[object], keywords: Mapping[str, object]
) -> str | None:
    """Return what is wrong with a call that gives True or False for a number.

    Parameters
    ----------
    document : str
        The function's docstring, which begins with its signature.
    positional : sequence
        The arguments, `self` first where there is one.
    keywords : mapping

    Returns
    -------
    str or None
        None where truth values are given for nothing but truth values.
    """
    signature = _documented(document.partition("\n")[0])
    annotations = {each.name: each.annotation for each in signature.parameters}
    values = {**dict(zip(annotations, positional, strict=False)), **keywords}
    for name, value in values.items():
        annotation = annotations.get(name, "")
        if isinstance(value, bool | np.bool_) and annotation.startswith(NUMERIC):
            wrong = _misfit(name, value, annotation)
            if wrong:
                return f"{signature.name}() is given {wrong}"
    return None


@lru_cache(maxsize=1024)
def _documented(line: str) -> Signature:
    """Read the first line of a docstring; a constructor has the name of its class."""
    signature = _signature(line, "")
    if signature.name != "__init__":
        return signature
    made = signature.parameters[0].annotation.rpartition(".")[2]
    return signature._replace(name=made)


def _complaint(
    signature: Signature, positional: Sequence[object], keywords: Mapping[str, object]
) -> str:
    known = {parameter.name: parameter for parameter in signature.parameters}
    names = ", ".join(name for name in known if name != "self") or "none"
    if len(positional) > signature.positional:
        return _too_many(signature, len(positional))
    values = dict(zip(known, positional, strict=False))
    for name, value in keywords.items():
        if name not in known:
            return f'has no argument "{name}"; arguments are {names}'
        if name in values:
            return f"is given {name} twice"
        values[name] = value
    missing = [name for name, each in known.items() if not each.optional and name not in values]
    if missing:
        return f"lacks {', '.join(missing)}; arguments are {names}"
    for name, value in values.items():
        if wrong := _misfit(name, value, known[name].annotation):
            return f"is given {wrong}"
    shown = ", ".join(f"{name} = {_show(value)}" for name, value in values.items())
    return f"cannot use {shown or 'no arguments'}; arguments are {names}"


def _too_many(signature: Signature, given: int) -> str:
    names = [parameter.name for parameter in signature.parameters]
    unnamed = [name for name in names[: signature.positional] if name != "self"]
    count = given - (names[:1] == ["self"])
    if not unnamed:
        named = names[signature.positional :]
        takes = f"{', '.join(named)}, by name" if named else "none"
        without = " without a name" if named else ""
        return f"is given {count} argument{'s' if count > 1 else ''}{without}; it takes {takes}"
    rest = ", the others by name" if len(names) > signature.positional else ""
    return f"is given {count} arguments without a name; it takes {', '.join(unnamed)}{rest}"


def _signature(text: str, name: str) -> Signature:
    """Read `package.Class(a: type = default, *, ...)` or `(a: type, ...) -> type`."""
    head, _, rest = text.partition("(")
    parameters: list[Parameter] = []
    positional = None
    for part in _split(rest[: _end(rest)], ","):
        own, _, annotation = part.strip().partition(": ")
        if own == "*":
            positional = len(parameters)
        elif own not in ("", "/"):
            kind, default, _ = annotation.partition(" = ")
            parameters.append(Parameter(own, kind, bool(default)))
    count = len(parameters) if positional is None else positional
    return Signature(head.rpartition(".")[2] or name, parameters, count)


def _split(text: str, separator: str) -> list[str]:
    """Split text outside of its brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def _end(text: str) -> int:
    """Return where the bracket closes that was opened before the text."""
    depth = 1
    for i, letter in enumerate(text):
        depth += (letter in "([{") - (letter in ")]}")
        if depth == 0:
            return i
    return len(text)


def _misfit(name: str, value: object, annotation: str) -> str:
    """Return what is wrong with a value, "" where nothing is known to be."""
    kinds = [kind.strip() for kind in _split(annotation, "|")]
    if any(_fits(value, kind) for kind in kinds):
        return ""
    start = f"{name} = {_show(value)} ({type(value).__name__})"
    is_array = len(kinds) == 1 and kinds[0].startswith("typing.Annotated[numpy")
    if is_array and (array := _array(value)) is not None:
        return f"{name} of shape {array.shape}; it must have shape {_shape(kinds[0])}"
    return f"{start}, which is no {_all_in_words(annotation)}"


def _fits(value: object, kind: str) -> bool:
    """Return whether pybind11 may take a value; kinds that are not known here may fit."""
    if test := TESTS.get(kind):
        return test(value)
    if kind.startswith("saltus._core."):
        known = getattr(_core, kind.rpartition(".")[2], object)
        return isinstance(value, known if isinstance(known, type) else object)
    if kind.startswith("collections.abc.Callable"):
        return callable(value)
    if kind.startswith("collections.abc.Sequence["):
        inside = kind.partition("[")[2][:-1]
        if isinstance(value, str | bytes) or not isinstance(value, Iterable):
            return False  # one name is no list of letters
        return all(_fits(each, inside) for each in value)
    if kind.startswith("typing.Annotated"):
        array, fixed = _array(value), FIXED.search(kind)
        if array is None or not fixed:
            return array is not None and _has_shape(array, _dimensions(kind))
        return array.shape == (int(fixed[1]),)
    return True


def _is_float(value: object) -> bool:
    if isinstance(value, bool | np.bool_):
        return False
    try:
        float(value)  # type: ignore[arg-type]  # that is the question
    except (TypeError, ValueError, OverflowError):
        return False
    return not isinstance(value, str | bytes | bytearray)


def _is_index(value: object) -> bool:
    if isinstance(value, bool | np.bool_):
        return False
    try:
        operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        return False
    return True


TESTS: dict[str, Callable[[object], bool]] = {
    "None": lambda value: value is None,
    "str": lambda value: isinstance(value, str),
    "bool": lambda value: isinstance(value, bool | np.bool_),
    "typing.SupportsFloat": _is_float,
    "typing.SupportsInt": _is_index,
    "typing.SupportsIndex": lambda _: False,  # stands beside one of the two before
}


def _all_in_words(annotation: str) -> str:
    kinds = [kind.strip() for kind in _split(annotation, "|")]
    return " or ".join(dict.fromkeys(word for kind in kinds if (word := _in_words(kind))))


def _in_words(kind: str) -> str:
    if fixed := FIXED.search(kind):
        return f"sequence of {fixed[1]} numbers"
    if kind.startswith("typing.Annotated"):
        return f"array of numbers of shape {_shape(kind)}"
    if kind.startswith("collections.abc.Callable"):
        return "function"
    if kind.startswith("collections.abc.Sequence["):
        each = _all_in_words(kind.partition("[")[2][:-1])
        return f"sequence of {'numbers' if each == 'number' else each}"
    name = kind.rpartition(".")[2]
    return "" if name == "SupportsIndex" else NUMBERS.get(name, name)


def _array(value: object) -> np.typing.NDArray[np.float64] | None:
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None


def _dimensions(kind: str) -> list[str]:
    return kind.partition('"[')[2].partition("]")[0].split(", ")


def _shape(kind: str) -> str:
    rows, *columns = _dimensions(kind)
    return f"({rows},)" if columns in ([], ["1"]) else f"({rows}, {columns[0]})"


def _has_shape(array: np.typing.NDArray[np.float64], dimensions: list[str]) -> bool:
    if len(dimensions) == 1:
        return array.shape == (int(dimensions[0]),)
    rows, columns = dimensions
    if columns == "1":
        return array.ndim in (1, 2) and rows in ("m", str(array.size)) and array.size in array.shape
    if array.ndim == 1:
        return rows == "m" and columns in ("n", str(array.size))
    if array.ndim != 2:
        return False
    sizes = zip(dimensions, array.shape, strict=True)
    return all(wanted in ("m", "n", str(size)) for wanted, size in sizes)


def _show(value: object) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 4]} ..."
