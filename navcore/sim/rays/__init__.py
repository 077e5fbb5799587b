"""Rays cast into the simulated orchard: what a LiDAR's beam meets first."""
