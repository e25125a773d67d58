# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Calls of the library: threads, seed, progress, Ctrl-C, and failures as exceptions."""

from __future__ import annotations

import os
import signal
import threading
import warnings
from ctypes import byref, c_void_p
from types import FrameType, TracebackType
from typing import Any, Callable, NoReturn

from ._declarations import Cancelled, ContextOptions, Kind, Progress, Status, Warn
from ._errors import Error, Failure, InputError, InputWarning, UsageError
from ._library import LIBRARY
from ._memory import Handle
from ._options import fill, size_of

#: Told the stage of the work and how much of it is done, 0 to 1.
ProgressCallback = Callable[[str, float], Any]

_EXCEPTIONS: dict[int, type[Error]] = {
    Kind.USAGE: UsageError, Kind.INPUT: InputError, Kind.FAILURE: Failure}


def _raise(status: int, sentence: str) -> NoReturn:
    sentence = sentence or LIBRARY.crease_status_sentence(status).decode()
    if status == Status.ERROR_NO_MEMORY:
        raise MemoryError(sentence)
    kind = _EXCEPTIONS.get(LIBRARY.crease_status_kind(status), Failure)
    raise kind(sentence, Status(status).name.removeprefix("ERROR_"))


class _Threads:
    """GNU's OpenMP waits forever for its threads in a process made by fork; the results are the same
    with one thread."""

    used = False  #: whether this process, or the one it was forked from, had more than one
    gone = False  #: whether they are those of another process

    @classmethod
    def after_fork(cls) -> None:
        cls.gone = cls.used

    @classmethod
    def allowed(cls, threads: int) -> int:
        cls.used = cls.used or threads != 1
        return 1 if cls.gone else threads


os.register_at_fork(after_in_child=_Threads.after_fork)


class Work:
    """A series of calls: `with Work(threads=4) as work: work.call("crease_...", ...)`.

    Python runs signal handlers in the callbacks, where an exception would be lost. So while the
    library works, an exception of a handler (KeyboardInterrupt) or of the progress callback is
    kept, the library is told to stop, and the exception is raised when it has.
    """

    def __init__(self, *, threads: int = 0, seed: int = 1, memory: int | str | None = None,
                 progress: ProgressCallback | None = None) -> None:
        self._progress = progress
        self._exception: BaseException | None = None
        self._odd: list[str] = []
        self._options = fill(LIBRARY.crease_context_options_default(), threads=threads, seed=seed,
                             memory=size_of("memory", memory))
        self._options.threads = _Threads.allowed(self._options.threads)
        self._options.cancelled = Cancelled(self._is_cancelled)
        self._options.warn = Warn(self._note_warning)
        if progress is not None:
            self._options.progress = Progress(self._tell_progress)
        self._context = self._create(self._options)
        self._handler: Any = None

    @staticmethod
    def _create(options: ContextOptions) -> Handle:
        out = c_void_p()
        status = LIBRARY.crease_context_create(byref(options), byref(out))
        if status == Status.ERROR_ARGUMENT:
            raise UsageError("threads: a whole number from 0 to 1024; 0 is one for each processor")
        if not out.value:
            _raise(status, "")
        return Handle(out.value, LIBRARY.crease_context_free)

    # ------------------------------------------------------------------------------------- calls

    def call(self, function: str, *arguments: Any) -> None:
        """Calls a function that returns a status; raises when it fails."""
        status = getattr(LIBRARY, function)(self._context, *arguments)
        if self._exception is not None:
            raise self._exception
        if status != Status.OK:
            _raise(status, LIBRARY.crease_context_message(self._context).decode(errors="replace"))

    def make(self, noun: str, function: str, *arguments: Any) -> Handle:
        """Calls a function whose last argument is the object that it makes."""
        out = c_void_p()
        free = getattr(LIBRARY, f"crease_{noun}_free")
        try:
            self.call(function, *arguments, byref(out))
        except BaseException:
            free(out)
            raise
        assert out.value is not None
        return Handle(out.value, free)

    # --------------------------------------------------------------------------------- callbacks

    def _is_cancelled(self, _user: int | None) -> int:
        return self._exception is not None

    def _note_warning(self, _user: int | None, sentence: bytes) -> None:
        self._odd.append(sentence.decode(errors="replace"))

    def _tell_progress(self, _user: int | None, stage: bytes, fraction: float) -> None:
        if self._exception is None and self._progress is not None:
            try:
                self._progress(stage.decode(), fraction)
            except BaseException as exception:
                self._exception = exception

    # ----------------------------------------------------------------------------------- signals

    def _on_interrupt(self, number: int, frame: FrameType | None) -> None:
        try:
            self._handler(number, frame)
        except BaseException as exception:
            self._exception = exception

    def __enter__(self) -> Work:
        in_main = threading.current_thread() is threading.main_thread()
        if in_main and callable(signal.getsignal(signal.SIGINT)):
            self._handler = signal.getsignal(signal.SIGINT)
            signal.signal(signal.SIGINT, self._on_interrupt)
        return self

    def __exit__(self, kind: type[BaseException] | None, exception: BaseException | None,
                 trace: TracebackType | None) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)
        if self._exception is not None and self._exception is not exception:
            raise self._exception
        for sentence in self._odd:
            warnings.warn(sentence, InputWarning, stacklevel=3)
