"""Calls of the library that take long: progress, Python's functions as callbacks, Ctrl-C."""

from __future__ import annotations

import signal
import threading
import weakref
from ctypes import c_void_p
from types import FrameType
from typing import Any, Callable, Optional

import numpy as np

from ._errors import check
from ._memory import from_address
from ._structs import DifFunction, DifGradient, DifProgress

#: What a user may be told of the share done: return False to cancel.
Progress = Optional[Callable[[float], object]]
#: Points (n, 3) to n numbers, or to n vectors (n, 3).
Function = Callable[[Any], Any]

_NO_PROGRESS = DifProgress(0)

#: Those whose handlers may well raise.
_SIGNALS = [
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGALRM", "SIGHUP", "SIGQUIT", "SIGUSR1", "SIGUSR2")
    if hasattr(signal, name)
]


class Handle:
    """Memory of the library, freed when nobody refers to this object any more."""

    def __init__(self, free: Callable[[c_void_p], None]) -> None:
        self.pointer = c_void_p()
        # Not at exit: arrays that other modules still hold would lose their memory.
        weakref.finalize(self, free, self.pointer).atexit = False


class _DeferredSignals:
    """While entered, handlers of signals written in Python run where it is `safe` and nowhere else.

    Python would run them at the first instruction of a callback, which no `try` in the callback can
    enclose; what they raise, KeyboardInterrupt above all, ctypes would print and forget.
    """

    def __init__(self) -> None:
        #: whether what a handler raises now gets caught
        self.safe = False
        self._handlers: dict[int, Callable[[int, FrameType | None], Any]] = {}
        self._arrived: list[tuple[int, FrameType | None]] = []

    def deliver(self) -> None:
        safe, self.safe = self.safe, False
        while self._arrived:
            number, frame = self._arrived.pop(0)
            self._handlers[number](number, frame)
        self.safe = safe

    def _note(self, number: int, frame: FrameType | None) -> None:
        self._arrived.append((number, frame))
        if self.safe:
            self.deliver()

    def __enter__(self) -> _DeferredSignals:
        if not in_main_thread():
            return self
        try:
            for number in _SIGNALS:
                handler = signal.getsignal(number)
                if callable(handler):
                    self._handlers[number] = handler
                    signal.signal(number, self._note)
        except ValueError:  # an interpreter that must not touch signals, and gets none
            pass
        except BaseException:  # a signal that came between
            self._restore()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._restore()
        except BaseException:  # likewise, from a handler that is in its place again
            self._restore()
            raise

    def _restore(self) -> None:
        for number, handler in self._handlers.items():
            if signal.getsignal(number) == self._note:  # unless a callback has put another there
                signal.signal(number, handler)


def in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


class Relay:
    """Stands between the library and callbacks in Python, for one call.

    The first exception of a callback, or of a signal's handler, cancels the call, and is raised
    where the call was made.
    """

    def __init__(self, progress: Progress = None) -> None:
        self._user_progress = progress
        self._signals = _DeferredSignals()
        self._error: BaseException | None = None
        # Signals arrive in the main thread only; elsewhere nobody would have use for a callback.
        wanted = progress is not None or in_main_thread()
        #: for the options' `progress`
        self.progress = DifProgress(self._on_progress) if wanted else _NO_PROGRESS

    def call(self, function: Callable[..., int], *arguments: Any) -> None:
        """Calls a function of the library and raises what went wrong."""
        with self._signals:
            status = function(*arguments)
        self.progress = _NO_PROGRESS  # the other one refers back to this object
        error, self._error = self._error, None
        if error is not None:
            try:
                raise error
            finally:
                del error  # it refers to this frame
        self._signals.deliver()
        check(status)

    def function(self, function: Function, what: str, vectors: bool = False) -> Any:
        """`function` as the library calls it, giving a number or a vector for each point."""
        if not callable(function):
            raise TypeError(f"{what} must be callable, got {type(function).__name__}")

        def evaluate(count: int, points: int, values: int) -> None:
            shape = (count, 3) if vectors else (count,)
            # A copy, for the user may keep it.
            given = np.asarray(function(from_address(points, (count, 3), "f8").copy()))
            if given.shape != shape:
                raise ValueError(
                    f"{what} returned an array of shape {given.shape} for points of shape "
                    f"({count}, 3); {shape} is needed"
                )
            from_address(values, shape, "f8", writeable=True)[...] = given

        kind = DifGradient if vectors else DifFunction
        return kind(lambda _, *arguments: self._guarded(evaluate, *arguments))

    def _on_progress(self, _: int, share_done: float) -> int:
        return self._guarded(self._tell, share_done)

    def _tell(self, share_done: float) -> bool:
        return self._user_progress is not None and self._user_progress(share_done) is False

    def _guarded(self, body: Callable[..., bool | None], *arguments: Any) -> int:
        """0 to go on, 1 to cancel."""
        try:
            if self._error is not None:
                return 1
            if not in_main_thread():
                return 1 if body(*arguments) else 0
            self._signals.safe = True
            self._signals.deliver()
            cancel = body(*arguments)
            self._signals.safe = False
            return 1 if cancel else 0
        except BaseException as error:
            if self._error is None:
                self._error = error
            if in_main_thread():
                self._signals.safe = False
            return 1
