"""How likely a plan is late: its days drawn, where driving and service last as they do."""
