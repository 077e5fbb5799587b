"""`rowpilot decode gnss FILE [--json]`."""

from __future__ import annotations

import json
import tracemalloc
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.drivers import gnss_log
from navcore.drivers.gnss_log import GnssLog
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
        (b"\xd3\x00\x13" + b"x\xb5\x62" * 40, "RTCM 3"),
        (b"\x1f\x8b\x08\x00" + bytes(40), "unpack it first"),
        (gga("103607.00").decode().encode("utf-16"), "save it as plain text"),
        (b'{"class":"TPV","lat":1.0}\n' * 3, "gpspipe"),
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


def test_without_a_date_the_time_of_day_is_shown(tmp_path: Path) -> None:
    path = tmp_path / "gga.log"
    path.write_bytes(gga("235959.90") + gga("000000.00"))
    result = runner.invoke(app, ["decode", "gnss", str(path), "--json"])
    assert [epoch["time"] for epoch in json.loads(result.stdout)["epochs"]] == ["23:59:59.900Z", "00:00:00.000Z"]


def test_text_without_checksums_is_refused_line_by_line_and_not_called_binary(tmp_path: Path) -> None:
    path = tmp_path / "bare.log"
    path.write_bytes(b"".join(gga(f"10360{n}.00").partition(b"*")[0] + b"\r\n" for n in range(3)))
    result = runner.invoke(app, ["decode", "gnss", str(path)])
    assert result.exit_code == 0
    assert result.stdout.startswith("0 epochs, 3 refused")
    assert result.stdout.count("no checksum at its end: $GNGGA") == 3


def test_a_log_without_epochs_is_json_too(tmp_path: Path) -> None:
    path = tmp_path / "compass.log"
    path.write_bytes(sentence("APHDM,218.634,M"))
    result = runner.invoke(app, ["decode", "gnss", str(path), "--json"])
    assert json.loads(result.stdout) == {"epochs": [], "refused": [], "refused_counts": {}, "unused": {"HDM": 1}}


def test_memory_does_not_grow_with_the_log(tmp_path: Path) -> None:
    path = tmp_path / "long.log"
    path.write_bytes(b"".join(gga(f"10{n // 60 % 60:02d}{n % 60:02d}.00") for n in range(15_000)))
    tracemalloc.start()
    assert sum(1 for _ in GnssLog(path).epochs()) == 15_000
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2_500_000  # bytes; a portion of 64 kB, all that comes of it, and the first 1 MB for its kind


def test_of_very_many_refusals_the_first_are_shown_and_all_are_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gnss_log, "KEPT_REFUSALS", 2)
    path = tmp_path / "cut.log"
    path.write_bytes(gga("103607.00") + b"$GNGGA,cut\r\n" * 5)
    result = runner.invoke(app, ["decode", "gnss", str(path)])
    assert result.stdout.count("refused at byte") == 2
    assert "truncated: no checksum at its end 5" in result.stdout


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
        assert set(json.loads(result.stdout)) == {"epochs", "refused", "refused_counts", "unused"}
