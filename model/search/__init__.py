"""Improvement of plans by ruin and recreate in the engine, on several threads."""
