"""Errors at the edge: the station's own exceptions, and the one table from exception to HTTP status.

It knows no web: processes that serve none raise them too, and would wait for it.
"""

from __future__ import annotations

from collections.abc import Iterable

from navcore import errors as navcore_errors


class StationError(navcore_errors.RowpilotError):
    """Root of the station's own errors. The text is a sentence that says what to do."""


class NotFoundError(StationError):
    """There is nothing of that id."""


class ConflictError(StationError):
    """Someone else changed it meanwhile, or the state does not allow it."""


class RefusedError(StationError):
    """A request that was understood and is not done now.

    Attributes:
        reasons: every reason, each a sentence for the operator.
    """

    def __init__(self, message: str, reasons: Iterable[str]) -> None:
        self.reasons = tuple(reasons)
        super().__init__(message)


class ForbiddenError(StationError):
    """Not logged in, or not from our own page."""


class TooLargeError(StationError):
    """A body beyond the limit of its route."""


class DiskFullError(StationError):
    """No room left on the disk."""


STATUS: dict[type[Exception], int] = {
    NotFoundError: 404,
    ConflictError: 409,
    RefusedError: 409,
    ForbiddenError: 403,
    TooLargeError: 413,
    DiskFullError: 507,
    navcore_errors.TransportError: 503,
    navcore_errors.InputError: 422,
    navcore_errors.RowpilotError: 500,
}


def status_of(error: Exception) -> int:
    """Status of the nearest class of the table, 500 for anything else."""
    return next((STATUS[kind] for kind in type(error).__mro__ if kind in STATUS), 500)


def body(message: str, reasons: Iterable[str] = ()) -> dict[str, object]:
    """The one form of an error."""
    return {"message": message, "reasons": list(reasons)}
