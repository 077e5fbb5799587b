"""Processes, clocks and wiring; the same objects in one thread for tests."""
