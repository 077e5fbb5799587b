"""The net that segments a corridor's ground: its pictures, its training, its file."""
