"""Durable jobs: long plans, comparisons and sweeps that outlive the process that works on them."""
