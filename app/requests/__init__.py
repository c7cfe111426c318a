"""Bytes -> a valid request, or every error of it at once."""
