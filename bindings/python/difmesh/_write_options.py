"""How a mesh is written: what Mesh.save() takes, as the library has it."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Union

from ._library import defaults
from ._memory import triple
from ._options import choice, choices, int32
from ._structs import DifMeshWriteOptions

_DRACO_METHODS = choices("DRACO_")
_COLOR_MAPS = choices("COLOR_MAP_")
_UP_AXES = choices("UP_")
_CHOICES = {
    "draco_method": ("draco_method", _DRACO_METHODS),
    "color_map": ("color_map", _COLOR_MAPS),
    "up": ("up", _UP_AXES),
}
#: ctypes would cut off their upper bits.
_INT32 = {"normals", "edge_ids", "draco_speed", "normal_bits", "generic_bits"}


def to_write_options(
    draco: Union[bool, int],
    color_range: Optional[Sequence[float]],
    local_origin: Optional[Sequence[float]],
    **given: Any,
) -> DifMeshWriteOptions:
    """The library's options; None leaves the default."""
    options = defaults(DifMeshWriteOptions, "dif_mesh_write_options_init")
    options.draco = draco is not False
    if not isinstance(draco, bool):
        options.position_bits = int32(draco, "draco")
        if options.position_bits == 0:
            raise ValueError("draco is 0; False, True and 1 to 24 bits are possible")
    if color_range is not None:
        low, high = (float(value) for value in color_range)
        if low == 0.0 and high == 0.0:  # which is the library's word for no range
            raise ValueError("color_range has no extent about 0")
        options.color_range = (low, high)
    if local_origin is not None:
        options.has_local_origin = 1
        options.local_origin = triple(local_origin, "local_origin")
    for name, value in given.items():
        if value is None:
            continue
        if name in _CHOICES:
            field, names = _CHOICES[name]
            setattr(options, field, choice(value, names, name))
        elif name in ("color_by", "format", "name"):
            setattr(options, name.replace("color", "color"), text_bytes(value, name))
        elif name in _INT32:
            setattr(options, name, int32(value, name))
        else:
            setattr(options, name, value)
    return options


def text_bytes(value: str, name: str) -> bytes:
    text = value.encode()
    if b"\0" in text:
        raise ValueError(f"{name} holds a zero byte")
    return text
