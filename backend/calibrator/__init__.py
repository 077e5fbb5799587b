"""A calibration under way: a process that looks at the board, kept by the station and asked by its routes."""
