"""The most of what any request may ask for, whatever the settings say, and who plans by default."""

DEFAULT_POLICY = "attention"
"""Policy that plans when a request names none."""

MAX_THREADS = 64
"""Most threads of a search that may be asked for."""

MAX_CUSTOMERS = 100_000
"""Most customers of any request."""

MAX_VEHICLES = MAX_CUSTOMERS
"""Most vehicles of a type."""

MAX_NUM_SAMPLES = 4096
"""Most samples of any request."""

MAX_LEGS = 10**9
"""Most legs of any request."""

MAX_TIME_LIMIT = 3600
"""Longest time limit of any request in seconds."""
