"""Files of fields. Those of meshes: read_mesh() and Mesh.save()."""

from __future__ import annotations

from ctypes import byref
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Handle
from ._errors import check, warn_of
from ._field import Field
from ._library import defaults, library
from ._memory import (
    TYPES,
    VALUE_TYPES,
    Path,
    Triple,
    field_struct,
    floats,
    from_address,
    index_triple,
    path_bytes,
    triple,
)
from ._options import choice, choices, int32
from ._structs import DifField, DifFieldReadOptions, DifFieldWriteOptions, DifRawLayout
from ._values import Labels, label_array

_FORMATS = choices("FIELD_FORMAT_")
_DTYPES: dict[int, np.dtype[Any]] = {number: dtype for dtype, number in TYPES.items()}


def _type_of(dtype: npt.DTypeLike, types: dict[np.dtype[Any], int]) -> int:
    kind = np.dtype(dtype)
    number = types.get(kind.newbyteorder("="))
    if number is None:
        known = ", ".join(str(known) for known in types)
        raise ValueError(f"dtype is {kind}; {known} are possible")
    return number


def read_field(
    path: Path,
    *,
    dims: Optional[Union[int, Sequence[int], npt.NDArray[Any]]] = None,
    dtype: npt.DTypeLike = np.float64,
    offset: int = 0,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    full_value: Optional[float] = None,
    empty_value: float = 0.0,
    labels: Optional[Labels] = None,
    outside_files: bool = False,
) -> Field:
    """Reads .npy, .nrrd or .nhdr, told by the extension, or a raw file if `dims` are given.

    dims: cells in x, y, z of a raw file; dtype: of its elements, ">f4" for big endian ones;
    offset: bytes before the first. They are x fastest, up to the end of the file.
    The fractions are a read-only view, with origin 0 and spacing 1 where the file tells none. An
    .npy array is indexed [k, j, i] whether it lies in C or Fortran order.
    spacing, origin: in place of what the file tells, which then is not judged.
    full_value, empty_value, labels: what values stand for, as for reconstruct(). If none is given,
    integers stand for value / largest value of their type, and those of other types than uint8 and
    uint16 become floats.
    outside_files: whether the data files of a header may lie outside its folder.
    What a user must know though it is no error is a difmesh.Warning.
    """
    layout = None
    if dims is not None:
        layout = defaults(DifRawLayout, "dif_raw_layout_init")
        layout.dims = index_triple(dims, "dims")
        layout.type = _type_of(dtype, VALUE_TYPES)
        layout.big_endian = np.dtype(dtype).newbyteorder(">") == np.dtype(dtype)
        layout.offset = offset
    handle = Handle(library.dif_field_file_free)
    given = None if layout is None else byref(layout)
    options, wanted = _read_options(spacing, origin, full_value, empty_value, labels)
    options.outside_files = bool(outside_files)
    name = path_bytes(path)
    check(library.dif_field_read_with(name, given, byref(options), byref(handle.pointer)))
    del wanted
    warn_of(handle.pointer, library.dif_field_file_warning)
    field = DifField()
    check(library.dif_field_file_field(handle.pointer, byref(field)))
    element = _DTYPES[field.type]
    fractions = from_address(
        field.data,
        tuple(field.dims)[::-1],
        element,
        strides=tuple(stride * element.itemsize for stride in field.strides)[::-1],
        owner=handle,
    )
    return Field(fractions, floats(field.spacing), floats(field.origin))


def _read_options(
    spacing: Optional[Triple],
    origin: Optional[Triple],
    full_value: Optional[float],
    empty_value: float,
    labels: Optional[Labels],
) -> tuple[DifFieldReadOptions, Optional[npt.NDArray[np.int64]]]:
    """The options, and the labels that must outlive them."""
    options = defaults(DifFieldReadOptions, "dif_field_read_options_init")
    if spacing is not None:
        options.has_spacing = True
        options.spacing = triple(spacing, "spacing")
    if origin is not None:
        options.has_origin = True
        options.origin = triple(origin, "origin")
    if full_value is not None:
        options.has_full_value = True
        options.full_value = full_value
        options.empty_value = empty_value
    elif empty_value != 0.0:
        raise ValueError("empty_value goes with full_value")
    wanted = None if labels is None else label_array(labels)
    if wanted is not None:
        options.label_count = wanted.size
        options.labels = wanted.ctypes.data
    return options, wanted


def write_field(
    path: Path,
    fractions: Any,
    *,
    spacing: Optional[Triple] = None,
    origin: Optional[Triple] = None,
    axes: str = "kji",
    format: Optional[str] = None,
    dtype: Optional[npt.DTypeLike] = None,
    gzip: bool = True,
    gzip_level: int = 6,
) -> None:
    """Writes .npy, or .nrrd, which holds spacing and origin too.

    fractions, spacing, origin, axes: as for reconstruct(). format: "npy" or "nrrd"; by default the
    extension tells. dtype: by default that of the fractions. gzip, gzip_level: of .nrrd, 1 to 9.
    The file appears when it is complete; on an error nothing is left behind.
    """
    field, array = field_struct(fractions, spacing, origin, axes)
    options = defaults(DifFieldWriteOptions, "dif_field_write_options_init")
    options.format = choice(format, _FORMATS, "format") if format is not None else 0
    options.type = _type_of(dtype, TYPES) if dtype is not None else 0
    options.gzip = bool(gzip)
    options.gzip_level = int32(gzip_level, "gzip_level")
    check(library.dif_field_write(byref(field), path_bytes(path), byref(options)))
    del array
