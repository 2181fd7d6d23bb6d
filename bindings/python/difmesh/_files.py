"""Files of fields. Those of meshes: read_mesh() and Mesh.save()."""

from __future__ import annotations

from ctypes import byref
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._calls import Handle
from ._errors import check
from ._field import Field
from ._library import defaults, library
from ._memory import (
    TYPES,
    Path,
    Triple,
    field_struct,
    floats,
    from_address,
    index_triple,
    path_bytes,
)
from ._options import choice, int32
from ._structs import DifField, DifFieldWriteOptions, DifRawLayout

_FORMATS = {"npy": 1, "nrrd": 2}
_DTYPES: dict[int, np.dtype[Any]] = {number: dtype for dtype, number in TYPES.items()}


def _type_of(dtype: npt.DTypeLike) -> int:
    kind = np.dtype(dtype)
    number = TYPES.get(kind.newbyteorder("="))
    if number is None:
        raise ValueError(f"dtype is {kind}; float32, float64, uint8 and uint16 are possible")
    return number


def read_field(
    path: Path,
    *,
    dims: Optional[Union[int, Sequence[int], npt.NDArray[Any]]] = None,
    dtype: npt.DTypeLike = np.float64,
    offset: int = 0,
) -> Field:
    """Reads .npy, .nrrd or .nhdr, told by the extension, or a raw file if `dims` are given.

    dims: cells in x, y, z of a raw file; dtype: of its elements, ">f4" for big endian ones;
    offset: bytes before the first. They are x fastest, up to the end of the file.
    The fractions are a read-only view, with origin 0 and spacing 1 where the file tells none. An
    .npy array is indexed [k, j, i] whether it lies in C or Fortran order.
    """
    layout = None
    if dims is not None:
        layout = defaults(DifRawLayout, "dif_raw_layout_init")
        layout.dims = index_triple(dims, "dims")
        layout.type = _type_of(dtype)
        layout.big_endian = np.dtype(dtype).newbyteorder(">") == np.dtype(dtype)
        layout.offset = offset
    handle = Handle(library.dif_field_file_free)
    given = None if layout is None else byref(layout)
    check(library.dif_field_read(path_bytes(path), given, byref(handle.pointer)))
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
    options.type = _type_of(dtype) if dtype is not None else 0
    options.gzip = bool(gzip)
    options.gzip_level = int32(gzip_level, "gzip_level")
    check(library.dif_field_write(byref(field), path_bytes(path), byref(options)))
    del array
