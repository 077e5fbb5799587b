"""All that touches CAN. Standard library and python-can only."""
