"""Where legs on roads come from: the operator's own maps, or a server that has them."""
