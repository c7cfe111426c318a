"""The console: pages that a browser shows, in `static/`, and what the service says to them."""
