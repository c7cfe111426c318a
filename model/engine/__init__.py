"""The engine: its library, and how what Python has becomes what it takes."""
