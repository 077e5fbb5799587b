"""Software renderer: primitives of an orchard, z-buffered polygons, shadow map, shading; without GPU or display."""
