"""Errors at the edge: the station's own exceptions, and the one table from exception to HTTP status."""

from __future__ import annotations

import logging
from collections.abc import Iterable

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from navcore import errors as navcore_errors

log = logging.getLogger("rowpilot.station")


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
INTERNAL = "The station made an error of its own. Nothing was changed; the log of the station has the details."

FRAMEWORK = {
    400: "The request cannot be read as JSON. Load the page again and repeat it.",
    404: "There is nothing at this address.",
    405: "This address does not take such a request. Load the page again.",
}


def status_of(error: Exception) -> int:
    """Status of the nearest class of the table, 500 for anything else."""
    return next((STATUS[kind] for kind in type(error).__mro__ if kind in STATUS), 500)


def body(message: str, reasons: Iterable[str] = ()) -> dict[str, object]:
    """The one form of an error."""
    return {"message": message, "reasons": list(reasons)}


def install(app: FastAPI) -> None:
    """Make the app answer every error in the one form."""
    app.add_exception_handler(navcore_errors.RowpilotError, answer_ours)
    app.add_exception_handler(RequestValidationError, answer_invalid)
    app.add_exception_handler(HTTPException, answer_http)
    app.add_exception_handler(Exception, answer_unforeseen)


async def answer_ours(request: Request, error: Exception) -> JSONResponse:
    """Our own sentences are meant to be read; a 500 among them is not."""
    status = status_of(error)
    if status == 500:
        return await answer_unforeseen(request, error)
    return JSONResponse(body(str(error), getattr(error, "reasons", ())), status)


async def answer_invalid(request: Request, error: Exception) -> JSONResponse:
    """Name the fields and never echo their values: NaN cannot be written as JSON, and text may be hostile."""
    assert isinstance(error, RequestValidationError)
    reasons = [f"{'.'.join(map(str, e['loc']))}: {e['msg']}" for e in error.errors()[:50]]
    return JSONResponse(body("The request is not in the expected form.", reasons), 422)


async def answer_http(request: Request, error: Exception) -> JSONResponse:
    """Errors of the framework: unknown path, wrong method, a body that is no JSON."""
    assert isinstance(error, HTTPException)
    message = FRAMEWORK.get(error.status_code, str(error.detail))
    return JSONResponse(body(message), error.status_code, headers=error.headers)


async def answer_unforeseen(request: Request, error: Exception) -> JSONResponse:
    """No trace and no path leaves the machine."""
    log.error("error in %s %s", request.method, request.url.path, exc_info=error)
    return JSONResponse(body(INTERNAL), 500, {"Connection": "close"})  # uvicorn does, and the browser should know
