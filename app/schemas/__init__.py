"""What goes over the wire: what clients may send, what they get back, and its description."""
