"""Plans on the road: a link for each vehicle's driver, and what drivers tell of their day."""
