"""From a path to a speed and a turn rate."""
