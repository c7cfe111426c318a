"""Improvement of plans by ruin and recreate, compiled, on several threads."""
