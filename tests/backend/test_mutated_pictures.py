"""GeoTIFFs damaged at random: each is imported or refused in a sentence, and none breaks its reader."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from backend.import_jobs import environment
from tests.backend.pictures import colours, write

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine
MUTANTS = 150  # of each seed; these seeds once found errors of GDAL that nobody translated
# One process for all, because each import begins with seconds of loading libraries.
IMPORTER = """
import json, sys
from pathlib import Path
from backend.orthophoto_check import CheckParams
from backend.confinement import limit_resources
from backend.orthophoto_import import import_picture
from navcore.errors import OrthophotoError
limit_resources(2 * 2**30, 300)
for name in sys.stdin.read().split():
    source = Path(name)
    try:
        import_picture(source, source.with_suffix(".out"), CheckParams(), lambda progress, message: None)
        said = ""
    except OrthophotoError as error:
        said = str(error)
    except MemoryError:
        said = "This picture needs too much memory."
    print(json.dumps([name, said]), flush=True)
"""


def mutants(folder: Path, seed: int) -> list[Path]:
    """Copies of three kinds of picture with some bytes changed, most of them in the header, or an end cut off."""
    rng = np.random.default_rng(seed)
    noise = rng.integers(0, 255, (3, 96, 96), np.uint8)
    originals = (
        write(folder / "plain.tif", noise),
        write(folder / "packed.tif", colours(96, 96), compress="deflate", tiled=True, blockxsize=32, blockysize=32),
        write(folder / "jpeg.tif", noise, compress="jpeg", photometric="YCBCR"),
    )
    made = []
    for number in range(MUTANTS):
        data = bytearray(originals[number % 3].read_bytes())
        for _ in range(rng.integers(1, 8)):
            reach = len(data) if rng.random() < 0.2 else min(len(data), 600)
            data[rng.integers(0, reach)] = rng.integers(0, 256)
        cut = int(rng.integers(1, len(data))) if rng.random() < 0.15 else len(data)
        path = folder / f"{number}.tif"
        path.write_bytes(data[:cut])
        made.append(path)
    return made


@pytest.mark.parametrize("seed", [1, 6, 8])
def test_no_damaged_picture_breaks_its_reader(tmp_path: Path, seed: int) -> None:
    names = [str(path) for path in mutants(tmp_path, seed)]
    done = subprocess.run(
        [sys.executable, "-c", IMPORTER], input=" ".join(names), env=environment(), capture_output=True, text=True,
        check=False, timeout=300,
    )  # fmt: skip
    told = [json.loads(line) for line in done.stdout.splitlines()]
    assert [name for name, _ in told] == names, (done.returncode, done.stderr[-2000:])
    refused = [said for _, said in told if said]
    assert all(said.endswith(".") and len(said) < 300 for said in refused)
    assert 20 < len(refused) < MUTANTS
