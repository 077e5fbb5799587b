"""A world built from the site map, with everything unkind in it."""
