"""Only a network's last layers trained, on few cells of the pictures: minutes on one core."""
