"""The vector map: the site map as points, nodes, lanes and road edges, and its files."""
