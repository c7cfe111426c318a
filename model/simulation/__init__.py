"""The decision process: what may come next, and what becomes of it. By the engine."""
