"""What a person finds out about the sensors once: the camera's lens, and where camera and LiDAR sit to each other."""
