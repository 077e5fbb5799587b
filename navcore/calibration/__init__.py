"""Camera models and sensor mounts."""
