"""Encode once; local publish and subscribe, request and reply."""
