"""The site map: orthophoto frame, rows, lanes, zones; and its GeoJSON form."""
