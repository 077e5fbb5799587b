"""The station: it plans, stores, shows."""
