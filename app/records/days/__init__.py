"""Days as they happen: what is ordered and what vehicles tell, and a plan after each event."""
