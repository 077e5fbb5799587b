"""What is compiled before a first drive."""

from __future__ import annotations

import subprocess
import sys

# In an interpreter of its own: in this one, other tests may have compiled it.
SCRIPT = """
from navcore.perception.plants.alignment_kernels import laid_over
from navcore.runtime.scan_warm_up import warm_up

warm_up()
print(len(laid_over.signatures))
"""


def test_no_scan_that_is_laid_over_known_plants_waits_for_a_compiler() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1"]
