"""What looks wrong with a valid request: warnings for whoever sent it, before there is a plan."""
