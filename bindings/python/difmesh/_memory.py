"""NumPy arrays on memory of the library, and the library's view of NumPy arrays."""

from __future__ import annotations

import os
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._constants import (
    FLOAT32,
    FLOAT64,
    INT8,
    INT16,
    INT32,
    INT64,
    UINT8,
    UINT16,
    UINT32,
    UINT64,
)
from ._field import Field
from ._structs import DifField, DifGrid

#: One number for all three axes, or three for x, y and z.
Triple = Union[float, Sequence[float], npt.NDArray[Any]]
Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

TYPES: dict[np.dtype[Any], int] = {
    np.dtype(np.float32): FLOAT32,
    np.dtype(np.float64): FLOAT64,
    np.dtype(np.uint8): UINT8,
    np.dtype(np.uint16): UINT16,
}
#: Those of values, of which fractions can be made.
VALUE_TYPES: dict[np.dtype[Any], int] = {
    **TYPES,
    np.dtype(np.int8): INT8,
    np.dtype(np.int16): INT16,
    np.dtype(np.int32): INT32,
    np.dtype(np.uint32): UINT32,
    np.dtype(np.int64): INT64,
    np.dtype(np.uint64): UINT64,
}


class _Memory:
    """Memory as NumPy asks for it. An array on it refers to this object, and so to the owner."""

    def __init__(self, owner: object, interface: dict[str, Any]) -> None:
        self.owner = owner
        self.__array_interface__ = interface


def from_address(
    address: int | None,
    shape: tuple[int, ...],
    dtype: Any,
    *,
    strides: tuple[int, ...] | None = None,
    owner: object = None,
    writeable: bool = False,
) -> npt.NDArray[Any]:
    """An array on memory that `owner` keeps; strides in bytes."""
    dtype = np.dtype(dtype)
    if not address:  # no elements
        empty = np.empty(shape, dtype)
        empty.flags.writeable = writeable
        return empty
    interface = {
        "version": 3,
        "shape": shape,
        "typestr": dtype.str,
        "data": (address, not writeable),
        "strides": strides,
    }
    return np.asarray(_Memory(owner, interface))


def floats(three: Any) -> tuple[float, float, float]:
    x, y, z = three
    return x, y, z


def triple(value: Triple, name: str) -> tuple[float, float, float]:
    """x, y, z of one number or three."""
    numbers = np.asarray(value, dtype=np.float64)
    if numbers.shape not in ((), (3,)):
        raise ValueError(
            f"{name} must be one number or three (x, y, z), got an array of shape {numbers.shape}"
        )
    x, y, z = np.broadcast_to(numbers, 3).tolist()
    return x, y, z


def index_triple(value: int | Sequence[int] | npt.NDArray[Any], name: str) -> tuple[int, int, int]:
    numbers = np.asarray(value)
    if numbers.dtype.kind not in "iu" or numbers.shape not in ((), (3,)):
        raise ValueError(f"{name} must be one integer or three (x, y, z), got {value!r}")
    x, y, z = np.broadcast_to(numbers, 3).tolist()
    return x, y, z


#: The faces of cells along x, y and z; None: the axis is uniform.
Edges = Optional[Sequence[Any]]


def grid_struct(
    dims: int | Sequence[int] | npt.NDArray[Any],
    spacing: Triple | None,
    origin: Triple | None,
    edges: Edges = None,
) -> DifGrid:
    struct = DifGrid(dims=index_triple(dims, "dims"))
    set_axes(struct, spacing, origin, edges)
    return struct


def set_axes(struct: Any, spacing: Triple | None, origin: Triple | None, edges: Edges) -> None:
    """Gives a DifGrid or DifField its axes; without spacing and origin, 1 and 0."""
    struct.origin = triple(0.0 if origin is None else origin, "origin")
    struct.spacing = triple(1.0 if spacing is None else spacing, "spacing")
    if edges is None:
        return
    tables = tuple(edges)
    set_faces(struct, tables)
    is_told_twice = spacing is not None or origin is not None
    if is_told_twice and all(table is not None for table in tables):
        raise ValueError("spacing or origin are given beside edges of all three axes")


def faces_array(table: Any, axis: str) -> npt.NDArray[np.float64]:
    """The faces of one axis as the library takes them; copied where their type asks for that."""
    if isinstance(table, np.ma.MaskedArray):
        raise TypeError(f"edges in {axis} are a masked array")
    array = np.asarray(table)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"edges in {axis} have dtype {array.dtype}, which holds no real numbers")
    return np.require(array, np.float64, ["A", "C"])


def set_faces(struct: Any, tables: tuple[Any, ...]) -> None:
    """Gives a DifGrid or DifField its faces, which live as long as it does."""
    if len(tables) != 3:
        raise ValueError(f"edges are three arrays or None, for x, y and z; got {len(tables)}")
    kept: list[npt.NDArray[np.float64] | None] = []
    for axis, cells, table in zip("xyz", struct.dims, tables):
        if table is None:
            kept.append(None)
            continue
        faces = faces_array(table, axis)
        if faces.shape != (cells + 1,):
            raise ValueError(
                f"edges in {axis} have the shape {faces.shape}; {cells} cells need ({cells + 1},)"
            )
        setattr(struct, f"faces_{axis}", faces.ctypes.data)
        kept.append(faces)
    struct._edges = tuple(kept)


def axis_order(axes: str) -> slice:
    """How an array's axes are to be taken so that they are those of x, y, z."""
    if axes == "kji":
        return slice(None, None, -1)
    if axes == "ijk":
        return slice(None)
    raise ValueError(f"axes is {axes!r}; 'kji' and 'ijk' are possible")


def fractions_array(fractions: Any) -> npt.NDArray[Any]:
    """Checks what the library cannot know; copies nothing but masks."""
    if isinstance(fractions, np.ma.MaskedArray):
        raise TypeError("fractions are a masked array; give cells without a value one, by filled()")
    array = np.asarray(fractions)
    if array.ndim != 3:
        raise ValueError(f"fractions must have 3 axes, got an array of shape {array.shape}")
    if array.dtype == np.bool_:
        return np.multiply(array, 255, dtype=np.uint8)
    if not array.dtype.isnative:
        raise TypeError(
            f"fractions have dtype {array.dtype.str}, whose byte order is not this machine's; "
            "convert them with astype(dtype.newbyteorder('='))"
        )
    if array.dtype not in TYPES:
        raise TypeError(
            f"fractions have dtype {array.dtype}; float32, float64, uint8, uint16 and bool are "
            "possible: give full_value or labels, or scale and convert them, for instance with "
            "astype(numpy.float32)"
        )
    _check_alignment(array)
    return array


def _check_alignment(array: npt.NDArray[Any]) -> None:
    size = array.itemsize
    if not array.flags.aligned or any(
        stride % size for stride, length in zip(array.strides, array.shape) if length > 1
    ):
        raise ValueError(
            f"fractions lie unaligned: strides of {array.strides} bytes from an address of "
            f"{array.ctypes.data % size} modulo {size}, for elements of {size} bytes; use copy()"
        )


def values_array(values: Any) -> npt.NDArray[Any]:
    """Values as the library takes them, copied where their type or place asks for that."""
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError("values are a masked array; give cells without a value one, by filled()")
    array = np.asarray(values)
    if array.ndim != 3:
        raise ValueError(f"values must have 3 axes, got an array of shape {array.shape}")
    if array.dtype == np.bool_:
        array = array.view(np.uint8)
    if array.dtype == np.float16:
        array = array.astype(np.float32)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    if array.dtype not in VALUE_TYPES:
        raise TypeError(f"values have dtype {array.dtype}; integers and floats are possible")
    return array if _is_regular(array) else array.copy()


def cell_array(cells: Any) -> npt.NDArray[np.int64]:
    """A list of cells as the library takes it."""
    given = np.asarray(cells)
    if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu":
        raise ValueError(
            f"cells must be integers of shape (n, 3), got {given.dtype} of shape {given.shape}"
        )
    return np.require(given, np.int64, ["A", "C"])


def _is_regular(array: npt.NDArray[Any]) -> bool:
    """Whether strides are whole elements."""
    return array.flags.aligned and all(stride % array.itemsize == 0 for stride in array.strides)


def field_struct(
    fractions: Any,
    spacing: Triple | None,
    origin: Triple | None,
    axes: str,
    edges: Edges = None,
) -> tuple[DifField, npt.NDArray[Any]]:
    """The library's view of fractions, and the array that must outlive it."""
    field = fractions if isinstance(fractions, Field) else None
    if field is not None and axes != "kji":
        raise ValueError("the axes of a Field are k, j, i")
    array = fractions_array(fractions if field is None else field.fractions)
    struct = array_struct(array, axes)
    if field is not None and edges is None:
        edges = field.edges
    set_axes(struct, spacing, origin, edges)
    if field is not None and spacing is None:
        struct.spacing = field.spacing
    if field is not None and origin is None:
        struct.origin = field.origin
    return struct, array


def array_struct(array: npt.NDArray[Any], axes: str) -> DifField:
    """The library's view of an array, with origin 0 and spacing 1."""
    order = axis_order(axes)
    strides = [
        stride // array.itemsize if length > 1 else 0
        for stride, length in zip(array.strides, array.shape)
    ]
    return DifField(
        data=array.ctypes.data,
        type=VALUE_TYPES[array.dtype],
        dims=array.shape[order],
        strides=tuple(strides[order]),
        spacing=(1.0, 1.0, 1.0),
    )


def path_bytes(path: Path) -> bytes:
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError("path holds a zero byte")
    return name


def address_of(array: npt.NDArray[Any]) -> int | None:
    """NULL for no elements."""
    return array.ctypes.data if array.size else None
