# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Objects of the library, and their numbers as arrays that nobody copies."""

from __future__ import annotations

from ctypes import c_void_p
from typing import Any, Callable, Sequence, Union

import numpy as np
from numpy.typing import DTypeLike, NDArray


class Handle:
    """An object of the library, freed with the last reference to it."""

    def __init__(self, address: int, free: Callable[[int], None]) -> None:
        self._as_parameter_ = address
        self._free = free

    def __del__(self) -> None:
        self._free(self._as_parameter_)


class Borrowed:
    """An object that belongs to another one and lives as long."""

    def __init__(self, address: int, owner: Held) -> None:
        self._as_parameter_ = address
        self.owner = owner


Held = Union[Handle, Borrowed]


class _Memory:
    """Numbers inside an object; the base of the arrays that show them."""

    def __init__(self, owner: Held, interface: dict[str, Any]) -> None:
        self.owner = owner
        self.__array_interface__ = interface


def view(owner: Held, address: int | None, shape: tuple[int, ...],
         dtype: DTypeLike = np.float64) -> NDArray[Any]:
    """The numbers at the address as an array that cannot be written to and keeps the owner."""
    if not address or 0 in shape:
        empty = np.empty(shape, dtype)
        empty.flags.writeable = False
        return empty
    return np.asarray(_Memory(owner, {"version": 3, "shape": shape, "data": (address, True),
                                      "typestr": np.dtype(dtype).str}))


def addresses(objects: Sequence[Held]) -> Any:
    """A C array of pointers to these objects."""
    return (c_void_p * len(objects))(*(each._as_parameter_ for each in objects))


def borrowed(owner: Held, array: int | None, count: int) -> list[Held]:
    """The objects that a C array of pointers inside their owner leads to."""
    if not array:
        return []
    pointers: Sequence[int] = list((c_void_p * count).from_address(array))
    return [Borrowed(pointer, owner) for pointer in pointers]
