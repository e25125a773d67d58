# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Keyword arguments put into the option structures of the library."""

from __future__ import annotations

import math
import operator
from ctypes import Array, Structure, c_bool, c_double, c_size_t, sizeof
from typing import Any, Mapping, Sequence, TypeVar

import numpy as np

from ._errors import UsageError

_Options = TypeVar("_Options", bound=Structure)
_Choice = TypeVar("_Choice")


def choose(name: str, word: str, choices: Mapping[str, _Choice]) -> _Choice:
    """What the program's word stands for."""
    if word not in choices:
        raise UsageError(f"{name}: one of {', '.join(choices)}, not {word!r}")
    return choices[word]


def size_of(name: str, value: int | str | None) -> int:
    """Bytes: a number, or text such as 500M or 2G, in powers of 1000; None is 0."""
    units = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9, "T": 10**12}
    if value is None:
        return 0
    if not isinstance(value, str):
        return _whole(name, value, c_size_t)
    digits = value.rstrip("kMGT")
    try:
        size = float(digits) * units[value[len(digits):]]
    except (KeyError, ValueError):
        size = math.nan
    if not 0 < size < 2**63:
        raise UsageError(f"{name}: bytes, such as 500M or 2G, not {value!r}")
    return int(size)


def _whole(name: str, value: Any, number_type: Any) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise UsageError(f"{name}: a whole number, not {value!r}") from None
    signed = number_type(-1).value < 0
    bits = 8 * sizeof(number_type) - signed
    if not -(2**bits) * signed <= number < 2**bits:
        raise UsageError(f"{name}: {number} is out of range")
    return number


def _real(name: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: a number, not {value!r}") from None
    if not math.isfinite(number):
        raise UsageError(f"{name}: a finite number, not {number}")
    return number


def _number(name: str, value: Any, number_type: Any) -> int | float | bool:
    if number_type is c_double:
        return _real(name, value)
    if number_type is c_bool:
        return bool(value)
    return _whole(name, value, number_type)


def _numbers(name: str, values: Any, array_type: Any) -> Array[Any]:
    flat: Sequence[Any] = list(np.asarray(values, dtype=object).ravel())
    if len(flat) != array_type._length_:
        raise UsageError(f"{name}: {array_type._length_} numbers, not {len(flat)}")
    numbers: Array[Any] = array_type(*(_number(name, each, array_type._type_) for each in flat))
    return numbers


def fill(options: _Options, **values: Any) -> _Options:
    """Puts what is given, that is, not None, in the place of the defaults."""
    types = dict(options._fields_)
    for name, value in values.items():
        if value is None:
            continue
        if issubclass(types[name], Array):
            setattr(options, name, _numbers(name, value, types[name]))
        else:
            setattr(options, name, _number(name, value, types[name]))
    return options
