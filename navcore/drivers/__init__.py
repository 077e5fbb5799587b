"""Receivers and sensors: bytes in, messages out."""
