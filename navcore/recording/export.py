"""A run for other programs: a table (CSV), a map (GeoJSON), a track (GPX 1.1)."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import msgspec

from navcore.errors import LogError
from navcore.geometry.geodesy import EnuFrame
from navcore.messages import MissionPlan, ModeSwitch, NavStatus
from navcore.recording.reader import read_log, read_typed, wall_offset_ns
from navcore.topics import NAV_PLAN, NAV_STATUS, NAV_SWITCH
from navcore.transport.codec import decode

COLUMNS = (
    "t_s", "time_utc", "x", "y", "yaw", "lat_deg", "lon_deg", "v", "omega", "state", "mode", "row_id", "progress",
    "lateral_error", "heading_error", "speed_limit", "speed_reason", "gnss_quality", "gnss_age_s", "row_age_s",
    "battery_v", "events",
)  # fmt: skip
NOT_IN_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
GPX_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n<gpx version="1.1" creator="Rowpilot" xmlns="http://www.topografix.com/GPX/1/1">'


class RunExport:
    """One run log, read once. Raises LogError if it holds no run."""

    def __init__(self, path: Path) -> None:
        self._offset_ns = wall_offset_ns(path)
        self._statuses = list(read_typed(path, NAV_STATUS.name, NavStatus))
        plans = [m.payload for m in read_log(path, (NAV_PLAN.name,))]
        if not self._statuses or not plans:
            raise LogError(f"{path.name} holds no driven run. Choose a run that was started.")
        self._plan = decode(MissionPlan, plans[-1])
        self._switches = list(read_typed(path, NAV_SWITCH.name, ModeSwitch))
        self._frame = EnuFrame(self._plan.datum)

    def csv(self) -> str:
        """One line per status (20 Hz), SI units unless the column says otherwise; empty where unknown."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(self._row(status) for status in self._statuses)
        return text.getvalue()

    def geojson(self) -> str:
        """Driven line, planned segments and mode switches, longitude and latitude (RFC 7946)."""
        features = [*self._driven(), *self._planned(), *self._switched()]
        return msgspec.json.encode({"type": "FeatureCollection", "features": features}).decode()

    def gpx(self) -> str:
        """The driven track with times; without heights, which nobody measures."""
        points = "\n".join(
            f'<trkpt lat="{lat:.9f}" lon="{lon:.9f}"><time>{time}</time></trkpt>' for lat, lon, time in self._track()
        )
        name = escape(NOT_IN_XML.sub(" ", self._plan.name))
        return f"{GPX_HEAD}\n<trk><name>{name}</name><trkseg>\n{points}\n</trkseg></trk>\n</gpx>\n"

    def _row(self, status: NavStatus) -> list[Any]:
        pose = status.pose
        place: list[Any] = ["", "", "", "", ""]
        if pose is not None:
            lat_deg, lon_deg, _ = self._frame.to_geodetic(pose.x, pose.y, 0.0)
            place = [f"{pose.x:.4f}", f"{pose.y:.4f}", f"{pose.yaw:.5f}", f"{lat_deg:.9f}", f"{lon_deg:.9f}"]
        t_s = (status.stamp_ns - self._statuses[0].stamp_ns) * 1e-9
        rest = (
            status.progress, status.lateral_error, status.heading_error, status.speed_limit, status.speed_reason,
            status.gnss_quality.value, status.gnss_age_s, status.row_age_s, status.battery_v,
            " ".join(event.name for event in status.events),
        )  # fmt: skip
        speeds = (f"{status.v:.4f}", f"{status.omega:.5f}", status.state.value, status.mode.value, status.row_id)
        return [f"{t_s:.3f}", self._time(status.stamp_ns), *place, *speeds, *rest]

    def _track(self) -> Iterator[tuple[float, float, str]]:
        for status in self._statuses:
            if status.pose is not None:
                lon_deg, lat_deg = self._lon_lat(status.pose.x, status.pose.y)
                yield lat_deg, lon_deg, self._time(status.stamp_ns)

    def _driven(self) -> Iterator[dict[str, Any]]:
        """A line has two positions at least; a run that ended before has none."""
        line = [[lon, lat] for lat, lon, _ in self._track()]
        if len(line) > 1:
            yield _feature("LineString", line, {"kind": "driven", "name": self._plan.name})

    def _planned(self) -> Iterator[dict[str, Any]]:
        for segment in self._plan.segments:
            line = [self._lon_lat(x, y) for x, y in segment.points]
            told = {"kind": "planned", "segment": segment.kind, "row_id": segment.row_id, "reverse": segment.reverse}
            yield _feature("LineString", line, told)

    def _switched(self) -> Iterator[dict[str, Any]]:
        for switch in self._switches:
            told = {"kind": "switch", "before": switch.before, "after": switch.after, "reason": switch.reason}
            yield _feature("Point", self._lon_lat(switch.x, switch.y), told)

    def _lon_lat(self, x: float, y: float) -> list[float]:
        lat_deg, lon_deg, _ = self._frame.to_geodetic(x, y, 0.0)
        return [lon_deg, lat_deg]

    def _time(self, stamp_ns: int) -> str:
        moment = datetime.fromtimestamp((stamp_ns + self._offset_ns) * 1e-9, UTC)
        return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def _feature(kind: str, coordinates: Any, properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "geometry": {"type": kind, "coordinates": coordinates},
        "properties": properties,
    }
