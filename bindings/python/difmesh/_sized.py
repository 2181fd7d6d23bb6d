"""What the structs of difmesh.h that may grow have in common."""

from __future__ import annotations

from ctypes import Structure, sizeof
from typing import Any


class Sized(Structure):
    """A struct that begins with its size, which it sets itself."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(struct_size=sizeof(type(self)), **fields)
