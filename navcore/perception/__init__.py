"""From pixels and scans to the row ahead."""
