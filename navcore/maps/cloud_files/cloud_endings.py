"""What files of points are called. Apart from their readers, which load libraries that a list of names needs not."""

from __future__ import annotations

CLOUD_ENDINGS = (".pcd", ".ply", ".las", ".laz", ".bin")
