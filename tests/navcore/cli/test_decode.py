"""`rowpilot decode gnss FILE [--json]`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app
from tests.navcore.drivers.nmea_text import gga, hdt, rmc, sentence

runner = CliRunner()


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "receiver.log"
    accuracy = sentence("GNGST,103607.00,0.1,0.02,0.01,0,0.03,0.04,0.05")
    whole = gga("103607.00") + rmc("103607.00") + accuracy + hdt(274.07)
    path.write_bytes(whole + whole.replace(b"103607.00", b"103608.00"))
    return path


def test_json_holds_each_epoch_and_each_refusal(log: Path) -> None:
    result = runner.invoke(app, ["decode", "gnss", str(log), "--json"])
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    [epoch] = [e for e in found["epochs"] if e["lat"] is not None]
    assert epoch["time"] == "2021-03-06T10:36:07.000Z"
    assert epoch["lat"] == pytest.approx(53.450657, abs=1e-9)
    assert epoch["lon"] == pytest.approx(-2.240410333, abs=1e-9)
    assert epoch["height"] == pytest.approx(104.5)
    assert epoch["quality"] == 4
    assert epoch["heading"] == pytest.approx(274.07)
    assert epoch["accuracy"] == pytest.approx(0.05)
    assert [r["reason"] for r in found["refused"]] == ["bad checksum"] * 3


def test_table_has_one_row_per_epoch_and_says_what_was_refused(log: Path) -> None:
    result = runner.invoke(app, ["decode", "gnss", str(log)])
    assert result.exit_code == 0
    assert "53.450657000" in result.stdout
    assert "4 rtk fixed" in result.stdout
    assert result.stdout.count("bad checksum: $GN") == 3


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (b"", "empty"),
        (b"\xb5\x62\x01\x07\x5c\x00" * 40, "u-blox UBX"),
        (b"SOURCETABLE 200 OK\r\nSTR;MOUNT;...\r\n", "NTRIP"),
        (b"no receiver ever wrote this\n", "no kind known"),
    ],
)
def test_log_without_text_is_refused_with_one_sentence(tmp_path: Path, content: bytes, word: str) -> None:
    path = tmp_path / "binary.log"
    path.write_bytes(content)
    result = runner.invoke(app, ["decode", "gnss", str(path), "--json"])
    assert result.exit_code == 2
    assert word in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert "Traceback" not in result.output


def test_missing_file_and_folder_are_refused_with_one_sentence(tmp_path: Path) -> None:
    for path in (tmp_path / "absent.log", tmp_path):
        result = runner.invoke(app, ["decode", "gnss", str(path)])
        assert result.exit_code == 2
        assert str(path) in result.stderr


BINARY = (
    "bu303-moving", "bu303-nofix", "naujoks-ntrip", "navcom", "ntrip_sourcetable", "rtcm3", "trimble-smt-360",
    "ublox-neo-m8p", "ublox-zed-f9p-rtk",
)  # fmt: skip


@pytest.mark.parametrize("name", BINARY)
def test_recorded_binary_log_is_refused_calmly(shared_data: Path, name: str) -> None:
    result = runner.invoke(app, ["decode", "gnss", str(shared_data / f"gnss/gpsd/{name}.log")])
    assert result.exit_code == 2
    assert len(result.stderr.strip().splitlines()) == 1


def test_every_recorded_text_log_is_decoded(shared_data: Path) -> None:
    text = [p for p in sorted((shared_data / "gnss").glob("*/*.log")) if p.stem not in BINARY]
    assert len(text) >= 16
    for path in text:
        result = runner.invoke(app, ["decode", "gnss", str(path), "--json"])
        assert result.exit_code == 0, path
        assert set(json.loads(result.stdout)) == {"epochs", "refused", "unused"}
