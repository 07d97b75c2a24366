"""What an HDF5 file holds, checked: wrong types, shapes and indices are a ModelError in words."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np
import numpy.typing as npt

from saltus._core import ModelError

if TYPE_CHECKING:
    import h5py

Member = TypeVar("Member", bound=Enum)
Table = npt.NDArray[np.void]

KINDS = {"f": "iuf", "i": "iu", "u": "iu", "b": "b?", "U": "SU", "?": "b?"}


class Stored:
    """An open file whose parts are read by name."""

    def __init__(self, file: h5py.File, path: Path) -> None:
        self.file = file
        self.path = path

    def __contains__(self, name: str) -> bool:
        return name in self.file

    def fail(self, what: str, reason: str) -> NoReturn:
        """Raise the ModelError of this file."""
        raise ModelError(f"{self.path} is no trajectory that saltus can read: {what} {reason}")

    def attribute(self, name: str, otherwise: object = None) -> Any:
        """Return an attribute as a plain number or text; `otherwise` where there is none."""
        if name not in self.file.attrs:
            if otherwise is None:
                self.fail(f'attribute "{name}"', "is not there")
            return otherwise
        value = self.file.attrs[name]
        value = value.item() if isinstance(value, np.generic) else value
        if not isinstance(value, bool | int | float | str):
            shape = np.shape(value)
            self.fail(f'attribute "{name}"', f"has shape {shape}; one number or text is needed")
        return value

    def number(self, name: str, otherwise: float | None = None) -> Any:
        """Return an attribute that is a number or a truth value."""
        value = self.attribute(name, otherwise)
        if isinstance(value, str):
            self.fail(f'attribute "{name}"', f"is {value!r}, which is no number")
        return value

    def member(self, name: str, kind: type[Member], otherwise: Member | None = None) -> Member:
        """Return the member of an enumeration that an attribute names."""
        value = self.attribute(name, None if otherwise is None else otherwise.name)
        if value not in kind.__members__:
            names = ", ".join(kind.__members__)
            self.fail(f'attribute "{name}"', f"is {value!r}; there are {names}")
        return kind[value]

    def dataset(self, name: str) -> Any:
        """Return all of a dataset, which must be there."""
        import h5py

        found = self.file.get(name)
        if not isinstance(found, h5py.Dataset):
            kind = "is not there" if found is None else "is a group, not a dataset"
            self.fail(f'dataset "{name}"', kind)
        return found[()]

    def array(self, name: str, shape: tuple[int | None, ...]) -> npt.NDArray[np.float64]:
        """Return an array of numbers, of any length where `shape` has None."""
        found = np.asarray(self.dataset(name))
        fits = found.ndim == len(shape) and all(
            wanted in (None, length) for wanted, length in zip(shape, found.shape, strict=True)
        )
        if not fits:
            wanted = ", ".join("any" if length is None else str(length) for length in shape)
            self.fail(f'dataset "{name}"', f"has shape {found.shape}; it must be ({wanted})")
        if found.dtype.kind not in KINDS["f"]:
            self.fail(f'dataset "{name}"', f"is of type {found.dtype}; numbers are needed")
        return found.astype(np.float64, copy=False)

    def names(self, name: str) -> tuple[str, ...]:
        """Return a list of texts."""
        found = np.asarray(self.dataset(name))
        if found.ndim != 1 or found.dtype.kind not in "OSU":
            self.fail(f'dataset "{name}"', f"is {found.dtype} of shape {found.shape}; texts needed")
        texts = tuple(x.decode() if isinstance(x, bytes) else x for x in found.tolist())
        if not all(isinstance(text, str) for text in texts):
            self.fail(f'dataset "{name}"', "holds what is no text")
        return texts

    def text(self, name: str) -> str:
        """Return one text."""
        found = self.dataset(name)
        if not isinstance(found, bytes | str):
            self.fail(f'dataset "{name}"', "is no text")
        return found.decode() if isinstance(found, bytes) else found

    def table(
        self,
        name: str,
        columns: np.dtype[np.void],
        otherwise: Mapping[str, object],
        *,
        optional: bool = False,
    ) -> Table:
        """Return a table column by column, those that are not there as `otherwise` has them.

        Older files have fewer columns, or none of an `optional` table.
        """
        if optional and name not in self.file:
            return np.zeros(0, columns)
        found = np.asarray(self.dataset(name))
        if found.ndim != 1 or found.dtype.names is None:
            self.fail(f'dataset "{name}"', f"is {found.dtype} of shape {found.shape}, no table")
        rows = np.zeros(len(found), columns)
        for column in columns.names or ():
            if column not in found.dtype.names:
                if column not in otherwise:
                    self.fail(f'dataset "{name}"', f'has no column "{column}"')
                rows[column] = otherwise[column]
                continue
            own, wanted = found.dtype[column], columns[column]
            if own.base.kind not in KINDS[wanted.base.kind] or own.shape != wanted.shape:
                self.fail(
                    f'dataset "{name}"', f'has a column "{column}" of type {own}, not {wanted}'
                )
            rows[column] = found[column]
        return rows

    def check_finite(self, name: str, values: npt.NDArray[np.float64]) -> None:
        """Fail on a row that has what is no number."""
        bad = ~np.isfinite(values.reshape(len(values), -1)).all(axis=1)
        if bad.any():
            row = int(np.argmax(bad))
            self.fail(f'dataset "{name}"', f"has in row {row} what is not finite: {values[row]}")

    def check_indices(
        self, name: str, column: str, values: npt.NDArray[np.integer[Any]], least: int, count: int
    ) -> None:
        """Raise where a column names rows of another table, or pairs, that are not there."""
        wrong = (values < least) | (values >= count)
        if wrong.any():
            row = int(np.argmax(wrong))
            span = f"{least} to {count - 1}" if count > least else "nothing"
            place = f'column "{column}" of row {row}'
            self.fail(f'dataset "{name}"', f"has {values[row]} in {place}; there is {span}")
