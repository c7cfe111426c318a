"""A valid request -> the problem that the planner knows, and how long that may take."""
