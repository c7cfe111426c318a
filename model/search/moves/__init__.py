"""What a turn of the search changes."""
