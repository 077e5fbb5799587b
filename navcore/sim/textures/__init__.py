"""Procedural pictures of bark, leaves, ground and sky, made from a seed: no file is shipped."""
