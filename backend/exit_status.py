"""How the station's own processes end where what they were given is at fault; they say why on stdout."""

from __future__ import annotations

UNREADABLE = 3
