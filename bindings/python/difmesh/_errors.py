"""Exceptions, one per status of difmesh.h that a caller may want to tell from others; warnings."""

from __future__ import annotations

import warnings
from ctypes import byref, c_char_p, c_void_p
from typing import Any

from . import _constants as c
from ._library import library


class Error(Exception):
    """What the library refused or failed at; the text is its own and names argument, cell or file.

    `status` is the number in difmesh.h, `name` its constant, "DIF_ERROR_INVALID_GRID" for instance.
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[type[Error], tuple[str, int]]:
        return type(self), (str(self), self.status)

    @property
    def name(self) -> str:
        text: bytes = library.dif_status_name(self.status)
        return text.decode()


class InvalidArgumentError(Error, ValueError):
    """An argument or option is out of range or does not fit the others."""


class InvalidGridError(InvalidArgumentError):
    """The number of cells, origin or spacing is unusable."""


class InvalidValueError(InvalidArgumentError):
    """NaN, infinity or too much overshoot in a field, or a NaN of a function."""


class TooLargeError(Error, OverflowError):
    """Sizes overflow, or more than 2^32 - 1 indices are needed."""


class OutOfMemoryError(Error, MemoryError):
    """The library could not allocate what it needs."""


class CancelledError(Error):
    """A progress callback returned False."""


class FileMissingError(Error, OSError):
    """An input file cannot be opened."""


class FileFormatError(Error, ValueError):
    """An input file is malformed, truncated or not supported."""


class FileWriteError(Error, OSError):
    """An output file cannot be written; nothing is left behind."""


class UnsupportedError(Error, NotImplementedError):
    """This build of the library lacks the part; see has()."""


class Warning(UserWarning):
    """What a user should know though it is no error: what was left out of a file or taken otherwise
    than it says, or that a field looks like a mask; see the module `warnings`."""


_TYPES: dict[int, type[Error]] = {
    c.ERROR_INVALID_ARGUMENT: InvalidArgumentError,
    c.ERROR_INVALID_GRID: InvalidGridError,
    c.ERROR_INVALID_VALUE: InvalidValueError,
    c.ERROR_TOO_LARGE: TooLargeError,
    c.ERROR_OUT_OF_MEMORY: OutOfMemoryError,
    c.ERROR_CANCELLED: CancelledError,
    c.ERROR_FILE_MISSING: FileMissingError,
    c.ERROR_FILE_FORMAT: FileFormatError,
    c.ERROR_FILE_WRITE: FileWriteError,
    c.ERROR_UNSUPPORTED: UnsupportedError,
}


def check(status: int) -> None:
    """Raises what the status of the call before, on this thread, stands for."""
    if status != c.OK:
        message: bytes = library.dif_last_message()
        raise _TYPES.get(status, Error)(message.decode(errors="replace"), status)


def warn_of(handle: c_void_p, getter: Any) -> None:
    """Issues the warnings that come with a handle; to be called by the function that the user
    called, whose line they name."""
    text = c_char_p()
    index = 0
    while True:
        check(getter(handle, index, byref(text)))
        if text.value is None:
            return
        warnings.warn(text.value.decode(errors="replace"), Warning, stacklevel=3)
        index += 1
