"""The engine: its library, problems as the arrays that it takes, and what rings while it works."""
