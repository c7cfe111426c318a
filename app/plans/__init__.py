"""A valid request -> a plan and its reply; a plan -> what is wrong with it."""
