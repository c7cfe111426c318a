"""What every request passes, and what runs the service: keys, load, logs, settings."""
