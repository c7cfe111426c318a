"""The versions, each with the way to it and back."""
