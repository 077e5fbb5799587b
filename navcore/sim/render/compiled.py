"""How the renderer's inner loops are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numpy as np
from numba import njit

P = ParamSpec("P")
R = TypeVar("R")

# In kernels a plain number is of double precision, which fits half as often into a vector.
single = cast("Callable[[float], float]", np.float32)
# An index that is not negative and says so, or each use of it would look for Python's counting from the end.
index = cast("Callable[[float], int]", np.uint32)


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile on first use and keep the machine code on disk.

    No fastmath: pictures must not depend on the compiler's freedom to reorder sums.
    """
    return cast("Callable[P, R]", njit(cache=True, nogil=True, error_model="numpy")(function))


def inlined(function: Callable[P, R]) -> Callable[P, R]:
    """As `compiled`, but melted into its caller: for what is called per pixel."""
    return cast("Callable[P, R]", njit(cache=True, nogil=True, error_model="numpy", forceinline=True)(function))


def uncounted(function: Callable[P, R]) -> Callable[P, R]:
    """As `inlined`, but without counting references to arrays: for loops that take arrays out of tuples.

    Counting took two thirds of their time. Such a function must not make an array.
    """
    lean: dict[str, Any] = {"_nrt": False}  # not in Numba's annotations
    return cast(
        "Callable[P, R]", njit(cache=True, nogil=True, error_model="numpy", forceinline=True, **lean)(function)
    )
