"""SLAMTEC RPLIDAR: requests, answers and rays, over a serial port or TCP (interface protocol 2.8; little-endian)."""
