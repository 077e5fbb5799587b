"""3D LiDARs that spin: Velodyne VLP-16 and Leishen C16, over UDP or from a capture of their packets."""
