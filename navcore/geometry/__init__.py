"""Angles, rigid transforms, lines, polylines, pinhole camera, geodesy."""
