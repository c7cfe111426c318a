"""Named plans that are kept until their owner deletes them, and links that show one to anybody."""
