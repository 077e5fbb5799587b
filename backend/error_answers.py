"""How the app answers an error: in one form, with a sentence for the reader and nothing of the station's inside."""

from __future__ import annotations

import logging

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from backend.errors import body, status_of
from navcore.errors import RowpilotError

log = logging.getLogger("rowpilot.station")

INTERNAL = "The station made an error of its own. Nothing was changed; the log of the station has the details."

FRAMEWORK = {
    400: "The request cannot be read as JSON. Load the page again and repeat it.",
    404: "There is nothing at this address.",
    405: "This address does not take such a request. Load the page again.",
}


def install(app: FastAPI) -> None:
    """Make the app answer every error in the one form."""
    app.add_exception_handler(RowpilotError, answer_ours)
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
