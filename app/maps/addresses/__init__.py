"""Where addresses are: from an extract itself, or from a geocoder."""
