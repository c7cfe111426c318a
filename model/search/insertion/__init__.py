"""Where a customer may be inserted, and what that costs."""
