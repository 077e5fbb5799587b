"""A 2D LiDAR's scan: to points, to clusters, to trunks."""
