"""What is compiled before a first drive."""

from __future__ import annotations

import subprocess
import sys

# In an interpreter of its own: in this one, other tests may have compiled it.
SCRIPT = """
from navcore.perception.along_kernels import blend, further_along, nearest
from navcore.perception.corridor_kernels import acquire, each_once, told
from navcore.perception.drawing_kernels import ahead, band, image_line, scan
from navcore.perception.foot_kernels import nearest_alone, rays
from navcore.perception.neighbour_kernels import gap
from navcore.perception.plants.alignment_kernels import laid_over
from navcore.perception.plants.association_kernels import in_sight, lead
from navcore.perception.plants.bending_kernels import about, averaged, basis, bends
from navcore.perception.plants.tracker_kernels import among, in_base, kept, meet
from navcore.perception.scan.cluster_kernels import trunks
from navcore.runtime.scan_warm_up import warm_up

warm_up()
of_scans = trunks, in_base, laid_over, meet, kept, among, scan
of_both = in_sight, lead, rays, nearest_alone, acquire, told, each_once, about, averaged, basis, bends
of_rows = gap, further_along, blend, nearest, ahead, band, image_line
print(*(f"{kernel.__name__}:{len(kernel.signatures)}" for kernel in of_scans + of_both + of_rows))
"""


def test_nothing_that_looks_at_scans_and_rows_waits_for_a_compiler() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True)
    assert {kernel.split(":")[1] for kernel in done.stdout.split()} == {"1"}, done.stdout
