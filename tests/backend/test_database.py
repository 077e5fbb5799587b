"""The database: made, upgraded, and killed while it writes."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext

from backend import models
from backend.database import Database, migrate, open_engine

WRITER = """
import sys
from pathlib import Path
from backend.audit import AuditBook
from backend.database import Database
book = AuditBook(Database(Path(sys.argv[1])))
number = 0
while True:
    book.write(None, "count", str(number), "done")
    print(number, flush=True)
    number += 1
"""


def test_an_empty_file_becomes_the_schema_of_the_models(tmp_path: Path) -> None:
    engine = open_engine(tmp_path / "new.sqlite3")
    migrate(engine)
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, models.Base.metadata) == []
    migrate(engine)
    engine.dispose()


def test_commits_are_durable_and_keys_are_checked(tmp_path: Path) -> None:
    database = Database(tmp_path / "new.sqlite3")
    with database.read() as session:
        raw = session.connection()
        pragmas = [
            raw.exec_driver_sql(f"PRAGMA {name}").scalar() for name in ("journal_mode", "synchronous", "foreign_keys")
        ]
    assert pragmas == ["wal", 2, 1]
    database.close()


def test_a_failed_write_leaves_nothing(tmp_path: Path) -> None:
    database = Database(tmp_path / "new.sqlite3")

    def fail() -> None:
        with database.write() as session:
            session.add(models.Login(digest="a", created=None, last_seen=None))

    with pytest.raises(Exception, match="NOT NULL"):
        fail()
    with database.read() as session:
        assert session.query(models.Login).count() == 0
    database.close()


def test_an_upgrade_that_fails_leaves_the_old_schema(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def break_off(*_: object) -> None:
        raise OSError("the power went")

    monkeypatch.setattr("alembic.op.create_index", break_off)
    path = tmp_path / "new.sqlite3"
    with pytest.raises(OSError, match="power"):
        Database(path)
    with sqlite3.connect(path) as connection:
        assert connection.execute("SELECT name FROM sqlite_master").fetchall() == []
    connection.close()
    monkeypatch.undo()
    Database(path).close()


@pytest.mark.parametrize("after", [1, 17, 60])
def test_nothing_acknowledged_is_lost_when_the_writer_is_killed(tmp_path: Path, after: int) -> None:
    path = tmp_path / "killed.sqlite3"
    acknowledged = -1
    with subprocess.Popen([sys.executable, "-c", WRITER, str(path)], stdout=subprocess.PIPE) as writer:
        assert writer.stdout is not None
        for line in writer.stdout:
            acknowledged = int(line)
            if acknowledged == after:
                writer.send_signal(signal.SIGKILL)
    database = Database(path)
    with database.read() as session:
        subjects = [int(record.subject) for record in session.query(models.AuditRecord)]
        assert session.connection().exec_driver_sql("PRAGMA integrity_check").scalar() == "ok"
    assert subjects == list(range(len(subjects)))
    assert len(subjects) >= acknowledged + 1
    database.close()
