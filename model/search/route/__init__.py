"""Routes as the search holds them: their sequence, and all that follows from it."""
