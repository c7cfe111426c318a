"""A large plan in parts: whole vehicles' routes that can be improved on their own."""
