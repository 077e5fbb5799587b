"""What lies in the folder of a 3D map."""

from __future__ import annotations

# Of the map itself. The report is written last, so a folder with it holds a whole map.
NDT, CLOUD, REPORT = "map.ndt", "cloud.laz", "report.json"
FILES = (NDT, CLOUD, "cloud.pcd", REPORT)
KEYFRAMES = "keyframes"
# Drawn of it when somebody first looks, the facts last; may be deleted at any time.
PICTURE, GROUND, FACTS = "above.png", "ground.npz", "above.json"
