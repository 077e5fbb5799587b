"""From recorded runs to maps."""
