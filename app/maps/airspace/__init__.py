"""Zones of the airspace as authorities publish them."""
