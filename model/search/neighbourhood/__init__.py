"""What legs a search sees, who is near to whom, and the numbers that customers have there."""
