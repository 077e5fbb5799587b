"""A Y-trellis as a LiDAR sees it: posts and wires that stay, leaves, grass and shoots that do not."""
