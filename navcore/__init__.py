"""Navigation library of Rowpilot: it thinks and drives. Read `navigator.py` first."""
