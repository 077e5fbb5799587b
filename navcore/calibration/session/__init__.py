"""A person with a board before the live camera: what was taken so far, what is missing, what comes of it."""
