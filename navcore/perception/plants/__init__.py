"""Trunks and posts as a 2D LiDAR follows them: where they stand, and which of them the camera sees too."""
