"""How the service bears load: bounded plans, abandoned requests, shutdown."""
