"""How zones of the airspace are written: the formats in which authorities publish them."""
