"""The simulated dual-antenna RTK receiver: a solution per epoch, sent late and sometimes damaged, as NMEA text."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import Datum
from navcore.messages import FixQuality
from navcore.sim.canopy import Canopy
from navcore.sim.nmea_text import ReceiverEpoch, sentences
from navcore.sim.noise import gauss_markov
from navcore.sim.rtk_solver import RtkSolution, RtkSolver, RtkSolverParams
from navcore.sim.sky import Floats, visible_satellites

_SKY_PERIOD_S = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssReceiverParams:
    """The receiver and its link.

    Attributes:
        rate_hz: epochs per second, 1 to 20; 5 or 10 on real robots.
        latency_s: least and most time from an epoch to its first byte, 0 to 1.
        late_share, late_s: share of epochs that are later still, and by how much at most.
        byte_gap_s: from the first half of an epoch's bytes to the second (115200 baud takes 22 ms for 260 bytes).
        damaged_share: share of sentences that arrive damaged.
        baseline_m: between the two antennas, for the heading.
        cold_start: without a fix at first; else the receiver has been on for a while.
        utc_start_s: UTC of the world's first instant, seconds since 1970 (2026-06-15 09:00).
        geoid_m: ellipsoidal height of mean sea level.
        outages_s: windows (from, to) after the start without any satellite.
        correction_outages_s: windows without corrections.
        solver: rules of the solution.
    """

    rate_hz: float = 5.0
    latency_s: tuple[float, float] = (0.10, 0.20)
    late_share: float = 0.005
    late_s: float = 0.3
    byte_gap_s: float = 0.012
    damaged_share: float = 0.002
    baseline_m: float = 0.8
    cold_start: bool = False
    utc_start_s: float = 1781514000.0
    geoid_m: float = 50.0
    outages_s: tuple[tuple[float, float], ...] = ()
    correction_outages_s: tuple[tuple[float, float], ...] = ()
    solver: RtkSolverParams = field(default_factory=RtkSolverParams)


@dataclass(frozen=True, slots=True, kw_only=True)
class AntennaState:
    """Truth of the main antenna in `map`, m and m/s, and the robot's yaw; `z` is above the `ground` there, m."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    yaw: float
    ground: float = 0.0


class GnssReceiver:
    """Epoch by epoch; `epoch()` must be called at the receiver's rate, `due()` says what has arrived."""

    def __init__(self, datum: Datum, canopy: Canopy, params: GnssReceiverParams, rng: np.random.Generator) -> None:
        self._params, self._rng, self._canopy = params, rng, canopy
        self._frame, self._lat_deg = EnuFrame(datum), datum.lat_deg
        self._solver = RtkSolver(params.solver, rng, cold_start=params.cold_start)
        self._sky: Floats = np.zeros((0, 3))
        self._sky_at_s = -math.inf
        self._age_s, self._heading_bias, self._heading_good_s = 1.0, 0.0, math.inf
        self._pending: list[tuple[int, bytes]] = []
        self._sent: ReceiverEpoch | None = None
        self.last: RtkSolution | None = None

    @property
    def period_ns(self) -> int:
        """From epoch to epoch."""
        return round(1e9 / self._params.rate_hz)

    def epoch(
        self, stamp_ns: int, elapsed_s: float, antenna: AntennaState, *, frozen: bool = False, starved: bool = False
    ) -> ReceiverEpoch:
        """Solve the epoch captured at `stamp_ns`, `elapsed_s` after the world's start, and send it.

        A frozen receiver sends fresh times with its last solution; a starved one gets no corrections.
        """
        solution = self._solve(elapsed_s, antenna, starved)
        self.last = solution
        epoch = self._describe(solution, elapsed_s, antenna)
        if frozen and self._sent is not None:
            epoch = replace(self._sent, utc_s=epoch.utc_s)
        self._sent = epoch
        self._send(stamp_ns, epoch)
        return epoch

    def due(self, now_ns: int) -> bytes:
        """Bytes that have arrived by now and were not handed out before."""
        count = sum(1 for arrival_ns, _ in self._pending if arrival_ns <= now_ns)
        arrived, self._pending = self._pending[:count], self._pending[count:]
        return b"".join(data for _, data in arrived)

    def _solve(self, elapsed_s: float, antenna: AntennaState, starved: bool) -> RtkSolution:
        if _within(elapsed_s, self._params.outages_s):
            return self._solver.lose_everything()
        if elapsed_s - self._sky_at_s >= _SKY_PERIOD_S:
            self._sky = visible_satellites(self._params.utc_start_s % 86400.0 + elapsed_s, self._lat_deg)
            self._sky_at_s = elapsed_s
        dt_s = 1.0 / self._params.rate_hz
        starved = starved or _within(elapsed_s, self._params.correction_outages_s)
        self._age_s = self._age_s + dt_s if starved else 1.0 + elapsed_s % 1.0
        loss = self._canopy.loss_db(antenna.x, antenna.y, antenna.z, self._sky)
        return self._solver.update(dt_s, self._sky, loss, self._age_s)

    def _describe(self, solution: RtkSolution, elapsed_s: float, antenna: AntennaState) -> ReceiverEpoch:
        east, north, up = solution.error_m
        above = antenna.ground + antenna.z
        lat, lon, height = self._frame.to_geodetic(antenna.x + east, antenna.y + north, above + up)
        noise = {FixQuality.RTK_FIXED: 0.02, FixQuality.RTK_FLOAT: 0.05}.get(solution.quality, 0.15)
        vx, vy = np.array((antenna.vx, antenna.vy)) + noise * self._rng.standard_normal(2)
        corrected = solution.quality in (FixQuality.RTK_FIXED, FixQuality.RTK_FLOAT)
        return ReceiverEpoch(
            utc_s=self._params.utc_start_s + elapsed_s, quality=solution.quality, lat_deg=lat, lon_deg=lon,
            height_m=height, geoid_m=self._params.geoid_m, satellites=solution.satellites, hdop=solution.hdop,
            std_m=solution.std_m, speed=math.hypot(vx, vy), course_deg=90.0 - math.degrees(math.atan2(vy, vx)),
            heading_deg=self._heading_deg(solution, antenna.yaw), age_s=self._age_s if corrected else None,
        )  # fmt: skip

    def _heading_deg(self, solution: RtkSolution, yaw: float) -> float | None:
        """Compass heading from the two antennas: sharp with a fix, wrong by degrees in float, else none."""
        dt_s, fixed = 1.0 / self._params.rate_hz, solution.quality is FixQuality.RTK_FIXED
        self._heading_good_s = self._heading_good_s + dt_s if fixed else 0.0
        if not fixed and solution.quality is not FixQuality.RTK_FLOAT:
            return None
        sharp = fixed and self._heading_good_s > 2.0
        correlated, white = (0.002, 0.003) if sharp else (0.06, 0.02)
        scale = 1.0 / self._params.baseline_m
        normals = self._rng.standard_normal(2)
        self._heading_bias = gauss_markov(
            self._heading_bias, correlated * scale, 2.0 if sharp else 15.0, dt_s, normals[0]
        )
        return 90.0 - math.degrees(yaw + self._heading_bias + white * scale * normals[1])

    def _send(self, stamp_ns: int, epoch: ReceiverEpoch) -> None:
        p, draw = self._params, self._rng.random(3)
        latency_s = p.latency_s[0] + draw[0] * (p.latency_s[1] - p.latency_s[0])
        latency_s += p.late_s * draw[2] if draw[1] < p.late_share else 0.0
        earliest = self._pending[-1][0] if self._pending else 0
        arrival = max(stamp_ns + round(latency_s * 1e9), earliest)
        text = b"".join(self._damaged(s.encode("ascii")) for s in sentences(epoch))
        half = len(text) // 2
        self._pending += [(arrival, text[:half]), (arrival + round(p.byte_gap_s * 1e9), text[half:])]

    def _damaged(self, sentence: bytes) -> bytes:
        """The sentence as the serial line delivers it: rarely with a wrong byte, cut short, or not at all."""
        if self._rng.random() >= self._params.damaged_share:
            return sentence
        at, how = int(self._rng.integers(1, len(sentence) - 2)), self._rng.random()
        if how < 0.6:
            return sentence[:at] + bytes([sentence[at] ^ (1 << int(self._rng.integers(0, 7)))]) + sentence[at + 1 :]
        return sentence[:at] if how < 0.9 else b""


def _within(elapsed_s: float, windows: tuple[tuple[float, float], ...]) -> bool:
    return any(start <= elapsed_s < end for start, end in windows)
