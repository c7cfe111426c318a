"""Published instance files -> requests."""
