"""The one SQLite file: opened so that what was acknowledged survives a power cut, migrated at start."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from alembic import command
from alembic.config import Config
from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.orm import Session

import migrations

BUSY_TIMEOUT_S = 10.0


class Database:
    """Short transactions on the station's tables. Safe for many threads."""

    def __init__(self, path: Path) -> None:
        """Open or make the file, and bring its schema up to date."""
        path.parent.mkdir(parents=True, exist_ok=True)
        self._engine = open_engine(path)
        migrate(self._engine)

    @contextmanager
    def read(self) -> Iterator[Session]:
        """A transaction that sees one state of the tables; what it loaded stays usable after it."""
        with Session(self._engine, expire_on_commit=False) as session:
            yield session

    @contextmanager
    def write(self) -> Iterator[Session]:
        """A transaction that is on disk (fsync) when the block ends without an error, and undone otherwise."""
        engine = self._engine.execution_options(sqlite_begin="BEGIN IMMEDIATE")
        with Session(engine, expire_on_commit=False) as session, session.begin():
            yield session

    def close(self) -> None:
        """Close all connections."""
        self._engine.dispose()


def open_engine(path: Path) -> Engine:
    """An engine with our pragmas and real transactions."""
    engine = create_engine(f"sqlite:///{path}", connect_args={"timeout": BUSY_TIMEOUT_S})
    event.listen(engine, "connect", _prepare)
    event.listen(engine, "begin", _begin)
    return engine


def _prepare(connection: sqlite3.Connection, record: Any) -> None:
    """FULL, because with NORMAL a power cut takes back commits that were acknowledged (sqlite.org/pragma.html)."""
    connection.isolation_level = None  # else the driver decides by itself when a transaction begins
    for pragma in ("journal_mode = WAL", "synchronous = FULL", "foreign_keys = ON"):
        connection.execute(f"PRAGMA {pragma}")


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql(connection.get_execution_options().get("sqlite_begin", "BEGIN"))


def migrate(engine: Engine) -> None:
    """Upgrade to the newest schema in one transaction: after a crash it is the old one or the new one."""
    writing = engine.execution_options(sqlite_begin="BEGIN IMMEDIATE")
    with writing.begin() as connection:
        command.upgrade(alembic_config(connection), "head")


def alembic_config(connection: Connection) -> Config:
    """Alembic's configuration, with the scripts found where the package lies, checkout or wheel."""
    config = Config()
    config.set_main_option("script_location", str(Path(migrations.__file__).parent).replace("%", "%%"))
    config.attributes["connection"] = connection
    return config
