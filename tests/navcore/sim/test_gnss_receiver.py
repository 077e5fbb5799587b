"""Under leaves RTK is lost, in the open it is not, and the text is what real receivers send."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from pynmeagps import NMEAReader

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import SiteMap
from navcore.messages import FixQuality
from navcore.sim.canopy import Canopy, CanopyParams
from navcore.sim.gnss_receiver import AntennaState, GnssReceiver, GnssReceiverParams
from navcore.sim.nmea_text import ReceiverEpoch
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard

PERIOD_NS = 200_000_000


@dataclass
class Survey:
    """Epochs of a drive north at 0.8 m/s along x = 23 (in the open south of y = 6, then inside a row)."""

    epochs: list[ReceiverEpoch]
    errors_m: list[float]
    places: list[float]
    clean: list[int]

    def between(self, low: float, high: float) -> Iterable[tuple[ReceiverEpoch, float]]:
        return [(e, m) for e, m, y in zip(self.epochs, self.errors_m, self.places, strict=True) if low < y < high]

    def fixed_share(self, low: float, high: float) -> float:
        return float(np.mean([e.quality is FixQuality.RTK_FIXED for e, _ in self.between(low, high)]))


Drive = Callable[..., Survey]


def receiver(farm: SiteMap, orchard: OrchardParams, seed: int, **params: object) -> GnssReceiver:
    canopy = Canopy(build_orchard(farm, orchard), CanopyParams(), seed)
    return GnssReceiver(farm.datum, canopy, GnssReceiverParams(**params), np.random.default_rng(seed))  # type: ignore[arg-type]


def drive(farm: SiteMap, trellis: Trellis, season: Season, seed: int = 0, **params: object) -> Survey:
    gnss = receiver(farm, OrchardParams(trellis=trellis, season=season), seed, **params)
    frame, survey = EnuFrame(farm.datum), Survey([], [], [], [])
    for k in range(1, 700):
        y = -30.0 + 0.16 * k
        epoch = gnss.epoch(k * PERIOD_NS, k * 0.2, AntennaState(x=23.0, y=y, z=1.2, vx=0.0, vy=0.8, yaw=math.pi / 2))
        east, north, _ = frame.to_enu(epoch.lat_deg, epoch.lon_deg, epoch.height_m)
        survey.epochs.append(epoch)
        survey.errors_m.append(math.hypot(east - 23.0, north - y))
        survey.places.append(y)
    return survey


@pytest.fixture(scope="module")
def leafy_roof(farm: SiteMap) -> Survey:
    return drive(farm, Trellis.ROOF, Season.GROWING)


def test_open_sky_gives_a_fix_of_one_to_two_centimetres(leafy_roof: Survey) -> None:
    open_sky = list(leafy_roof.between(-30.0, 2.0))
    assert all(epoch.quality is FixQuality.RTK_FIXED for epoch, _ in open_sky)
    assert np.quantile([error for _, error in open_sky], 0.95) < 0.03
    assert np.median([error for _, error in open_sky]) > 0.003


def test_under_a_roof_in_leaf_a_fix_is_rare(leafy_roof: Survey) -> None:
    assert leafy_roof.fixed_share(10.0, 64.0) < 0.2


def test_under_a_roof_in_leaf_the_error_is_decimetres_to_metres(leafy_roof: Survey) -> None:
    errors = [error for _, error in leafy_roof.between(10.0, 64.0)]
    assert 0.3 < np.median(errors) < 5.0


def test_the_heading_is_lost_or_wrong_by_degrees_under_a_roof_in_leaf(leafy_roof: Survey) -> None:
    headings = [epoch.heading_deg for epoch, _ in leafy_roof.between(10.0, 64.0)]
    wrong = [h is None or abs(math.remainder(h, 360.0)) > 1.0 for h in headings]
    assert np.mean(wrong) > 0.5


def test_the_fix_returns_only_seconds_after_leaving_the_row(leafy_roof: Survey) -> None:
    beyond = [(e.quality, y) for e, y in zip(leafy_roof.epochs, leafy_roof.places, strict=True) if y > 67.5]
    first = next(y for quality, y in beyond if quality is FixQuality.RTK_FIXED)
    assert 2.0 < (first - 67.5) / 0.8 < 12.0


def test_a_bare_orchard_keeps_the_fix(farm: SiteMap) -> None:
    assert drive(farm, Trellis.ROOF, Season.DORMANT).fixed_share(10.0, 64.0) > 0.9


def test_walls_of_leaves_cost_less_than_a_roof(farm: SiteMap, leafy_roof: Survey) -> None:
    walls = drive(farm, Trellis.VSP, Season.GROWING)
    assert walls.fixed_share(10.0, 64.0) > 0.8 > leafy_roof.fixed_share(10.0, 64.0)


def test_on_higher_ground_the_antenna_is_higher(farm: SiteMap) -> None:
    gnss, heights = receiver(farm, OrchardParams(), 0), []
    for k in range(1, 200):
        state = AntennaState(x=0.0, y=-20.0, z=1.2, vx=0.0, vy=0.0, yaw=0.0, ground=3.0 if k >= 100 else 0.0)
        heights.append(gnss.epoch(k * PERIOD_NS, k * 0.2, state).height_m)
    assert np.mean(heights[100:]) - np.mean(heights[50:99]) == pytest.approx(3.0, abs=0.05)  # m


def test_without_corrections_the_fix_ends(farm: SiteMap) -> None:
    survey = drive(farm, Trellis.ROOF, Season.DORMANT, correction_outages_s=((10.0, 200.0),))
    assert survey.epochs[40].quality is FixQuality.RTK_FIXED
    assert survey.epochs[-1].quality is FixQuality.SINGLE


def test_an_outage_window_leaves_no_position(farm: SiteMap) -> None:
    survey = drive(farm, Trellis.ROOF, Season.DORMANT, outages_s=((10.0, 20.0),))
    assert {e.quality for e in survey.epochs[50:99]} == {FixQuality.NONE}


def text(farm: SiteMap, **params: object) -> tuple[bytes, list[tuple[int, bytes]]]:
    gnss, chunks = receiver(farm, OrchardParams(), 0, **params), []
    for k in range(1, 300):
        gnss.epoch(k * PERIOD_NS, k * 0.2, AntennaState(x=0.0, y=-20.0, z=1.2, vx=0.0, vy=0.0, yaw=0.0))
        for now_ns in range(k * PERIOD_NS, (k + 1) * PERIOD_NS, 5_000_000):
            data = gnss.due(now_ns)
            if data:
                chunks.append((now_ns - k * PERIOD_NS, data))
    return b"".join(data for _, data in chunks), chunks


def test_an_independent_parser_reads_every_undamaged_sentence(farm: SiteMap) -> None:
    data, _ = text(farm, damaged_share=0.0)
    lines = data.splitlines(keepends=True)
    parsed = [NMEAReader.parse(line) for line in lines]
    assert {m.msgID for m in parsed} == {"GGA", "RMC", "GST", "HDT"}
    assert len(lines) > 1100


def test_the_first_epoch_says_where_and_how_the_robot_stands(farm: SiteMap) -> None:
    data, _ = text(farm, damaged_share=0.0)
    gga, rmc, gst, hdt = (NMEAReader.parse(line) for line in data.splitlines(keepends=True)[:4])
    frame = EnuFrame(farm.datum)
    east, north, up = frame.to_enu(gga.lat, gga.lon, gga.alt + gga.sep)
    assert (east, north, up) == pytest.approx((0.0, -20.0, 1.2), abs=0.1)
    assert gga.quality == FixQuality.RTK_FIXED
    assert hdt.headingT == pytest.approx(90.0, abs=2.0)
    assert 0.0 < gst.stdLat < 0.05
    assert (rmc.status, str(rmc.date)) == ("A", "2026-06-15")


def test_some_sentences_arrive_damaged(farm: SiteMap) -> None:
    data, _ = text(farm, damaged_share=0.05)
    bad = 0
    for line in data.splitlines(keepends=True):
        body, _, told = line.strip().partition(b"*")
        checksum = 0
        for byte in body[1:]:
            checksum ^= byte
        bad += not line.startswith(b"$") or told != b"%02X" % checksum
    assert 20 < bad < 120


def test_bytes_arrive_a_tenth_to_a_fifth_of_a_second_late_and_in_pieces(farm: SiteMap) -> None:
    _, chunks = text(farm, late_share=0.0, latency_s=(0.10, 0.19))
    firsts = [delay for delay, data in chunks if data.startswith(b"$GNGGA")]
    assert min(firsts) >= 100_000_000
    assert max(firsts) <= 195_000_000
    assert max(firsts) - min(firsts) > 50_000_000
    assert any(not data.endswith(b"\r\n") for _, data in chunks)


def test_the_same_seed_gives_the_same_bytes(farm: SiteMap) -> None:
    assert text(farm)[0] == text(farm)[0]


def test_the_correlated_error_wanders_slowly(leafy_roof: Survey) -> None:
    errors = np.array([error for _, error in leafy_roof.between(10.0, 64.0)])
    steps = [abs(b - a) for a, b in pairwise(errors)]
    assert np.median(steps) < 0.5 * np.median(errors)
