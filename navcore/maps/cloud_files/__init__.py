"""Files of points that others write and read: PCD, PLY, LAS and LAZ, KITTI's .bin."""
