"""What the service keeps in its database: jobs, plans, dispatches."""
