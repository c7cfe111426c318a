"""What a rule means in compiled code, once each, and how code is compiled."""
