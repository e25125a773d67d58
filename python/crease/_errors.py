# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What can go wrong, by what a caller can do about it."""

from __future__ import annotations


class Error(Exception):
    """A call of crease that failed. Its text says what, where and what to do."""

    #: Which error it is, as crease.h calls it: "FORMAT", "TOO_FEW_POINTS", ...
    status: str

    def __init__(self, sentence: str, status: str = "ARGUMENT") -> None:
        super().__init__(sentence)
        self.status = status


class UsageError(Error, ValueError):
    """An argument or option is out of its range: mend the call."""


class InputError(Error):
    """A file or the points are not usable: mend the input."""


class Failure(Error, RuntimeError):
    """Neither the call nor the input is to blame: a disk is full, a computation did not succeed."""


class InputWarning(UserWarning):
    """The input is usable but odd."""
