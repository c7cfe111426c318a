"""From places, no-fly areas and wind to the legs between nodes."""
