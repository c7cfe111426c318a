"""Customers who can be served together alone, whom a search that inserts one at a time misses."""
