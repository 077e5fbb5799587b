"""Registration of scans to an NDT map."""
