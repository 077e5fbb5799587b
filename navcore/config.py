"""Composes every module's own parameters into one tree; a run keeps the tree it used."""
