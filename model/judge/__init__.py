"""What every plan is judged by, in plain Python: shares no code with what is judged."""
