"""Rows, headlands, lanes and turns found in a 3D map."""
