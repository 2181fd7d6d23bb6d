"""Options that several functions share."""

from __future__ import annotations

import operator
from typing import Any, Sequence

from . import _constants
from ._calls import Relay
from ._library import defaults
from ._structs import DifOptions


def choices(prefix: str) -> dict[str, int]:
    """The names of an enumeration of difmesh.h, "plic" for PLACEMENT_PLIC, and their numbers.

    Without that of 0, which leaves the choice to the library and here is not asking for any.
    """
    names = {
        name[len(prefix) :].lower(): value
        for name, value in vars(_constants).items()
        if name.startswith(prefix) and value != 0
    }
    if not names:
        raise ValueError(f"difmesh.h has no enumeration DIF_{prefix}...")
    return names


_PLACEMENTS = choices("PLACEMENT_")
_NORMALS = choices("NORMALS_")
_SIDES = choices("SIDE_")


def to_options(relay: Relay, boundary: str | Sequence[str], **given: Any) -> DifOptions:
    """The library's options; None leaves the default."""
    options = defaults(DifOptions, "dif_options_init")
    options.progress = relay.progress
    options.boundary = six_kinds(boundary)
    for name, value in given.items():
        if name == "placement":
            options.placement = choice(value, _PLACEMENTS, name)
        elif name == "normals":
            options.normals = choice(value, _NORMALS, name)
        elif name == "threads":
            options.threads = int32(value, name)
        elif value is not None:
            setattr(options, name, value)
    return options


def six_kinds(boundary: str | Sequence[str]) -> tuple[int, ...]:
    """The constants of one name for all sides, or of six."""
    six = (boundary,) * 6 if isinstance(boundary, str) else tuple(boundary)
    if len(six) != 6:
        raise ValueError(
            f"boundary is {boundary!r}; one name or six are needed, from x low to z high"
        )
    return tuple(choice(side, _SIDES, "a side") for side in six)


def choice(name: str, names: dict[str, int], what: str) -> int:
    """The constant of a name."""
    try:
        return names[name]
    except (KeyError, TypeError):
        known = ", ".join(repr(known) for known in names)
        raise ValueError(f"{what} is {name!r}; {known} are possible") from None


def int32(value: int, name: str) -> int:
    """ctypes would cut off the upper bits."""
    number = operator.index(value)
    if not -(2**31) <= number < 2**31:
        raise ValueError(f"{name} is {number}, which is beyond any range")
    return number
