"""The tables. Documents are stored as the JSON that navcore's codec writes; only the station touches this file."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any

from sqlalchemy import DateTime, ForeignKey, LargeBinary, String, Text, TypeDecorator
from sqlalchemy.engine import Dialect
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column, relationship


class UtcDateTime(TypeDecorator[datetime]):
    """Wall-clock time; SQLite drops the zone, so it is taken off and put back here."""

    impl = DateTime
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """Aware to naive UTC."""
        return value.astimezone(UTC).replace(tzinfo=None) if value is not None else None

    def process_result_value(self, value: Any | None, dialect: Dialect) -> datetime | None:
        """Naive UTC to aware."""
        return value.replace(tzinfo=UTC) if value is not None else None


class Base(DeclarativeBase):
    """Root of all tables."""

    type_annotation_map = {datetime: UtcDateTime, bytes: LargeBinary, str: Text}  # noqa: RUF012


class Orthophoto(Base):
    """A finished picture; its pixels are in `orthophotos/<id>.tif`."""

    __tablename__ = "orthophoto"

    id: Mapped[str] = mapped_column(String(16), primary_key=True)
    file_name: Mapped[str]
    crs: Mapped[str]
    width_px: Mapped[int]
    height_px: Mapped[int]
    resolution: Mapped[float]
    west_deg: Mapped[float]
    south_deg: Mapped[float]
    east_deg: Mapped[float]
    north_deg: Mapped[float]
    west_3857: Mapped[float]
    south_3857: Mapped[float]
    east_3857: Mapped[float]
    north_3857: Mapped[float]
    min_zoom: Mapped[int]
    max_zoom: Mapped[int]
    created: Mapped[datetime]


class Site(Base):
    """A farm. `document` is a `SiteMap`; `version` counts its changes."""

    __tablename__ = "site"

    id: Mapped[str] = mapped_column(String(16), primary_key=True)
    version: Mapped[int] = mapped_column(nullable=False)
    name: Mapped[str]
    document: Mapped[bytes]
    orthophoto_id: Mapped[str | None] = mapped_column(ForeignKey("orthophoto.id", ondelete="SET NULL"), index=True)
    updated: Mapped[datetime]
    orthophoto: Mapped[Orthophoto | None] = relationship(lazy="joined")

    __mapper_args__ = {"version_id_col": version}  # noqa: RUF012


class TrunkMap(Base):
    """The trunks of a site. `document` is navcore's `TrunkMap`; `run_ids` are the runs in it, parted by spaces."""

    __tablename__ = "trunk_map"

    site_id: Mapped[str] = mapped_column(String(16), ForeignKey("site.id", ondelete="CASCADE"), primary_key=True)
    document: Mapped[bytes]
    run_ids: Mapped[str]
    updated: Mapped[datetime]


class Mission(Base):
    """A mission of a site. `document` is a `navcore.maps.mission.Mission`."""

    __tablename__ = "mission"

    id: Mapped[str] = mapped_column(String(16), primary_key=True)
    site_id: Mapped[str] = mapped_column(ForeignKey("site.id", ondelete="CASCADE"), index=True)
    version: Mapped[int] = mapped_column(nullable=False)
    name: Mapped[str]
    document: Mapped[bytes]
    updated: Mapped[datetime]

    __mapper_args__ = {"version_id_col": version}  # noqa: RUF012


class Run(Base):
    """A drive, with its own copies of site, mission and plan: later edits do not reach them."""

    __tablename__ = "run"

    id: Mapped[str] = mapped_column(String(16), primary_key=True)
    site_id: Mapped[str | None] = mapped_column(ForeignKey("site.id", ondelete="SET NULL"), index=True)
    mission_id: Mapped[str | None] = mapped_column(ForeignKey("mission.id", ondelete="SET NULL"), index=True)
    site_name: Mapped[str]
    mission_name: Mapped[str]
    site_document: Mapped[bytes]
    mission_document: Mapped[bytes]
    plan_document: Mapped[bytes]
    link_loss: Mapped[str]
    outcome: Mapped[str]
    state: Mapped[str | None]
    reason: Mapped[str]
    started: Mapped[datetime] = mapped_column(index=True)
    ended: Mapped[datetime | None]
    duration_s: Mapped[float]
    distance_m: Mapped[float]
    progress: Mapped[float]
    mean_lateral_error: Mapped[float | None]
    max_lateral_error: Mapped[float | None]
    mode_switches: Mapped[int]
    holds: Mapped[int]


class RunEvent(Base):
    """Something that happened in a run, `t_s` after its start."""

    __tablename__ = "run_event"

    id: Mapped[int] = mapped_column(primary_key=True)
    run_id: Mapped[str] = mapped_column(ForeignKey("run.id", ondelete="CASCADE"), index=True)
    t_s: Mapped[float]
    kind: Mapped[str]
    text: Mapped[str]


class Login(Base):
    """A logged-in browser. Only the digest of its cookie is kept."""

    __tablename__ = "login"

    digest: Mapped[str] = mapped_column(String(64), primary_key=True)
    created: Mapped[datetime]
    last_seen: Mapped[datetime]


class AuditRecord(Base):
    """Who asked for what, and whether it was done. `login` is the start of the login's digest."""

    __tablename__ = "audit_record"

    id: Mapped[int] = mapped_column(primary_key=True)
    at: Mapped[datetime] = mapped_column(index=True)
    login: Mapped[str]
    action: Mapped[str]
    subject: Mapped[str]
    outcome: Mapped[str]
