"""HTTP and WebSocket routes, a file a subject."""
