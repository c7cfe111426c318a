"""The command `tandem`, a file for each group of its commands."""
