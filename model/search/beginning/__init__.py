"""What a search begins with."""
