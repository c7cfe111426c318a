"""What networks see of a problem and say of what comes next."""
