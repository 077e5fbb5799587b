"""A run as an MCAP file: recorder, player, export."""
