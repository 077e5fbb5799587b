"""Uploads: streamed to disk, never held in memory, never named by the client."""

from __future__ import annotations

import os
import shutil
from collections.abc import AsyncIterator
from pathlib import Path

from anyio import open_file
from starlette.requests import ClientDisconnect, Request

from backend.errors import DiskFullError, TooLargeError
from backend.ids import new_id
from backend.settings import Settings
from navcore.errors import InputError


async def receive(request: Request, settings: Settings) -> Path:
    """Write the body to a file of the upload folder. Nothing stays behind if it cannot be received whole."""
    settings.upload_dir.mkdir(parents=True, exist_ok=True)
    refuse_too_large(request, settings)
    path = settings.upload_dir / f"{new_id()}.upload"
    try:
        await _write(request, path, settings)
    except BaseException:
        path.unlink(missing_ok=True)
        raise
    return path


def lent(own: Path, settings: Settings) -> Path:
    """A file of the station as if it had been uploaded, to be deleted after use; `own` stays."""
    path = settings.upload_dir / f"{new_id()}{own.suffix}"
    try:
        os.link(own, path)
    except OSError:  # a disk of its own, or one that knows no links
        _check_size(own.stat().st_size, settings)
        shutil.copyfile(own, path)
    return path


def refuse_too_large(request: Request, settings: Settings) -> None:
    """By the length that the browser announces, before a byte is written."""
    announced = request.headers.get("content-length", "0")
    _check_size(int(announced) if announced.isdecimal() else 0, settings)


async def _write(request: Request, path: Path, settings: Settings) -> None:
    written = 0
    async with await open_file(path, "xb") as file:
        async for chunk in _chunks(request):
            written += len(chunk)
            if written > settings.upload_limit_bytes:
                raise _too_large(settings)
            try:
                await file.write(chunk)
            except OSError as error:
                raise _disk_full() from error


async def _chunks(request: Request) -> AsyncIterator[bytes]:
    try:
        async for chunk in request.stream():
            yield chunk
    except ClientDisconnect as error:
        raise InputError("The upload broke off. Send the file again.") from error


def _check_size(size: int, settings: Settings) -> None:
    if size > settings.upload_limit_bytes:
        raise _too_large(settings)
    if size + settings.keep_free_bytes > shutil.disk_usage(settings.upload_dir).free:
        raise _disk_full()


def _too_large(settings: Settings) -> TooLargeError:
    limit = settings.upload_limit_bytes / 2**30
    return TooLargeError(
        f"The file is larger than {limit:.1f} GB. Export a smaller area, or a JPEG-compressed GeoTIFF."
    )


def _disk_full() -> DiskFullError:
    return DiskFullError("The station's disk is too full for this file. Delete old runs or sites, then try again.")


def clear(settings: Settings) -> None:
    """Remove what an interrupted station left behind."""
    settings.upload_dir.mkdir(parents=True, exist_ok=True)
    for entry in os.scandir(settings.upload_dir):
        shutil.rmtree(entry.path) if entry.is_dir(follow_symlinks=False) else os.unlink(entry.path)
