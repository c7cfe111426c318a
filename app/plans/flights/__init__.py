"""Flights of a plan as files that flight controllers read."""
