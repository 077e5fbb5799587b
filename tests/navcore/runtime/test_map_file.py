"""The farm's 3D map may come, change, be cut off or be another farm's while the robot runs: each is said."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from navcore.maps.ndt.ndt_file import ndt_map_bytes
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Datum
from navcore.runtime.map_file import NONE_YET, MapFile

FARM = Datum(lat_deg=36.0, lon_deg=119.0, height_m=30.0)


@pytest.fixture(scope="module")
def whole() -> bytes:
    """The file of a small map of the farm."""
    ndt_map = NdtMap(datum=FARM)
    ndt_map.add(np.random.default_rng(1).uniform(-5.0, 5.0, (2000, 3)))
    return ndt_map_bytes(ndt_map)


def lay(path: Path, data: bytes, moment: int) -> None:
    """Written at another moment than before, s."""
    path.write_bytes(data)
    os.utime(path, (moment, moment))


def usable(file: MapFile) -> bool:
    return file.localizer is not None


def test_a_map_that_comes_later_is_taken_and_one_that_goes_is_given_up(tmp_path: Path, whole: bytes) -> None:
    path = tmp_path / "farm.ndt"
    file = MapFile(path, FARM)
    assert not usable(file)
    assert file.reason == NONE_YET
    lay(path, whole, 1)
    file.look()
    assert usable(file)
    path.unlink()
    file.look()
    assert file.reason == NONE_YET


@pytest.mark.parametrize("kept", [0.0, 0.01, 0.5, 0.99])
def test_a_map_that_is_cut_off_while_it_is_used_is_given_up_with_a_reason(
    tmp_path: Path, whole: bytes, kept: float
) -> None:
    path = tmp_path / "farm.ndt"
    lay(path, whole, 1)
    file = MapFile(path, FARM)
    assert usable(file)
    lay(path, whole[: int(kept * len(whole))], 2)
    file.look()
    assert not usable(file)
    assert "cut off" in file.reason or "no NDT map" in file.reason


def test_the_map_of_another_farm_is_refused(tmp_path: Path, whole: bytes) -> None:
    lay(tmp_path / "farm.ndt", whole, 1)
    file = MapFile(tmp_path / "farm.ndt", replace(FARM, lat_deg=36.01))
    assert not usable(file)
    assert "another farm" in file.reason
