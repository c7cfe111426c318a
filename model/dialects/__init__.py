"""Requests in the words of other planners."""
