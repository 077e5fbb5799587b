"""Paper B: rows from camera and 2D LiDAR as published, and its rivals."""
