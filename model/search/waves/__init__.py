"""What leaves now and what waits, by what may come: decisions wave after wave."""
