"""What paper A published of its row lines and centre lines, as shares."""

from __future__ import annotations

from navcore.perception.row_perception import RowMethod
from navcore.sim.orchard import Season

# Table 8: valid frames of all rows.
VALID = {RowMethod.LEAST_SQUARES: 0.8031, RowMethod.RANSAC: 0.9166, RowMethod.TEMPORAL_RANSAC: 0.9724}
# Tables 5 to 7: the same in rows 1 to 4.
VALID_BY_ROW = {
    RowMethod.LEAST_SQUARES: (0.813, 0.763, 0.837, 0.802), RowMethod.RANSAC: (0.923, 0.896, 0.914, 0.935),
    RowMethod.TEMPORAL_RANSAC: (0.962, 0.976, 0.985, 0.982),
}  # fmt: skip
VALID_TABLES = {
    RowMethod.LEAST_SQUARES: "Paper A, Table 5: valid row lines, least squares",
    RowMethod.RANSAC: "Paper A, Table 6: valid row lines, RANSAC",
    RowMethod.TEMPORAL_RANSAC: "Paper A, Table 7: valid row lines, temporal RANSAC",
}
# Table 9: valid row lines of temporal RANSAC by growth stage, rows 1 to 4.
LINES_BY_ROW = {
    Season.BUDDING: (0.985, 0.980, 0.972, 0.991), Season.GROWING: (0.976, 0.981, 0.979, 0.987),
    Season.MATURING: (0.962, 0.976, 0.985, 0.982),
}  # fmt: skip
# Table 10: right centre lines by growth stage, rows 1 to 4; Table 11: of all rows.
CENTRES_BY_ROW = {
    Season.BUDDING: (0.926, 0.957, 0.943, 0.948), Season.GROWING: (0.905, 0.941, 0.933, 0.928),
    Season.MATURING: (0.912, 0.937, 0.923, 0.917),
}  # fmt: skip
CENTRES = {Season.BUDDING: 0.9437, Season.GROWING: 0.9269, Season.MATURING: 0.9228}
