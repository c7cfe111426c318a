"""A problem as arrays for the engine, and what rings while that works."""
