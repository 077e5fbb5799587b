"""The NDT map: Gaussians of the points in cubes of space, on several scales, and its file."""
