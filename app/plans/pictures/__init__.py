"""Plans as pictures without a browser: a map with a timeline under it, or a printable page."""
