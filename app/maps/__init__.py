"""Where places are and how far apart: roads, addresses, the map's streets."""
