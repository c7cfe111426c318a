"""VROOM's jobs and vehicles: planned by VROOM's objective and rules."""
