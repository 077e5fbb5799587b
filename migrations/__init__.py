"""Schema migrations of the station's database, run at start by `backend.database`."""
