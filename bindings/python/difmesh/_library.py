"""Finds and loads libdifmesh, and declares its functions to ctypes."""

from __future__ import annotations

import ctypes
import os
from ctypes import byref
from pathlib import Path
from typing import TypeVar

from ._prototypes import FUNCTIONS
from ._sized import Sized

#: The interface that this package is written for; see "Stability" in difmesh.h.
_NAME = "libdifmesh.so.0"


def _load() -> ctypes.CDLL:
    given = os.environ.get("DIFMESH_LIBRARY")
    beside = Path(__file__).with_name(_NAME)
    path = given or (str(beside) if beside.exists() else _NAME)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        where = "which DIFMESH_LIBRARY names" if given else "the library that difmesh calls"
        raise ImportError(
            f"cannot load {path}, {where}: {error}. It is looked for where the environment "
            f"variable DIFMESH_LIBRARY says, then at {beside}, then where the system's loader "
            f"looks (LD_LIBRARY_PATH, /usr/local/lib after ldconfig, and so on)"
        ) from error


library = _load()


def _declare() -> None:
    for name, (result, arguments) in FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(
                f"{library._name} has no function {name}: it is older than this package"
            ) from None
        function.restype = result
        function.argtypes = arguments


_declare()

_Struct = TypeVar("_Struct", bound=Sized)


def defaults(struct: type[_Struct], init: str) -> _Struct:
    """A struct with the library's defaults."""
    result = struct()
    status = getattr(library, init)(byref(result), result.struct_size)
    if status != 0:  # a struct that the library refuses: not of this interface
        raise ImportError(f"{library._name} refuses {struct.__name__}, status {status}")
    return result
