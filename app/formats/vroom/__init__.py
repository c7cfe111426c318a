"""`POST /vroom`: VROOM's request in, VROOM's reply out."""
