"""From a drive with a 3D LiDAR to one map of what stands there."""
