"""The trellis reference: posts, wires and what else stays in an orchard from season to season."""
