"""What a start waits for: no process loads a heavy library that it can do without until it is asked for it."""

from __future__ import annotations

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    ("module", "spared"),
    [
        ("navcore.runtime.supervisor", "numba scipy cv2 torch pyproj shapely"),
        ("backend.server", "numba torch viser laspy scipy.optimize scipy.ndimage scipy.spatial"),
        ("backend.scene", "numba scipy torch fastapi"),
        ("navcore.runtime.world_process", "torch onnxruntime navcore.perception"),
    ],
)
def test_a_process_starts_without_what_it_may_never_need(module: str, spared: str) -> None:
    script = f"import sys, {module}; print(*[name for name in {spared.split()!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
