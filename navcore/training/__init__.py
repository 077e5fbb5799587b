"""Data sets and training of the detectors."""
