"""What is left of a plan that is under way, as a problem of its own, and back."""
