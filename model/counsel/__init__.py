"""Why plans are as they are, what else could be done, and what would help, as the judge decides."""
