"""Poses of a drive held together by what was measured between them, and on the Earth."""
