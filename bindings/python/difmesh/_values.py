"""Fractions of the values of scanners and segmentations."""

from __future__ import annotations

from ctypes import byref
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._errors import check
from ._field import Field
from ._library import library
from ._memory import array_struct, values_array

#: Values of which cells are inside: one, or several.
Labels = Union[int, Sequence[int], npt.NDArray[Any]]


def fractions_from_values(
    values: Any, full_value: float, empty_value: float = 0.0
) -> npt.NDArray[np.float64]:
    """(value - empty_value) / (full_value - empty_value), values beyond counting as 0 or 1.

    values: an array with three axes, of bool, integers or floats. The result has its shape. NaN
    stays NaN. full_value may be the smaller one.
    """
    array = values_array(values)
    fractions = np.empty(array.shape)
    field = array_struct(array, "kji")
    check(
        library.dif_fractions_from_values(
            byref(field), float(empty_value), float(full_value), fractions.ctypes.data
        )
    )
    return fractions


def fractions_from_labels(values: Any, labels: Labels) -> npt.NDArray[np.uint8]:
    """255, that is 1, where a value is one of the labels, else 0.

    values: an array with three axes, of bool, integers or floats. The result has its shape.
    """
    array = values_array(values)
    wanted = label_array(labels)
    fractions = np.empty(array.shape, np.uint8)
    field = array_struct(array, "kji")
    check(
        library.dif_fractions_from_labels(
            byref(field), wanted.size, wanted.ctypes.data, fractions.ctypes.data
        )
    )
    return fractions


def label_array(labels: Labels) -> npt.NDArray[np.int64]:
    wanted: npt.NDArray[Any] = np.atleast_1d(np.asarray(labels))
    if wanted.ndim != 1 or wanted.dtype.kind not in "iub" or wanted.size == 0:
        raise ValueError(f"labels are integers, one or several, got {labels!r}")
    if int(wanted.max()) > np.iinfo(np.int64).max:
        raise ValueError(f"labels above {np.iinfo(np.int64).max} are not possible")
    whole: npt.NDArray[np.int64] = wanted.astype(np.int64)
    return whole


def taken_as_asked(
    fractions: Any, full_value: Optional[float], empty_value: float, labels: Optional[Labels]
) -> Any:
    """What stands for the field where its values are to be taken by a full value or labels."""
    if full_value is None and labels is None:
        if empty_value != 0.0:
            raise ValueError("empty_value goes with full_value")
        return fractions
    if full_value is not None and labels is not None:
        raise ValueError("labels exclude full_value")
    values = fractions.fractions if isinstance(fractions, Field) else fractions
    made: Any = (
        fractions_from_labels(values, labels)
        if labels is not None
        else fractions_from_values(values, float(full_value or 0.0), empty_value)
    )
    if isinstance(fractions, Field):
        return Field(made, fractions.spacing, fractions.origin)
    return made
