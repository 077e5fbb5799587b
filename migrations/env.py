"""Alembic's entry: runs inside the transaction that `backend.database.migrate` began."""

from __future__ import annotations

from alembic import context

from backend.models import Base


def run() -> None:
    """Migrate over the connection that was handed in."""
    context.configure(
        connection=context.config.attributes["connection"],
        target_metadata=Base.metadata,
        render_as_batch=True,
        transaction_per_migration=False,
    )
    context.run_migrations()


run()
