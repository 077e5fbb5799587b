"""From a mission on the site map to a path."""
