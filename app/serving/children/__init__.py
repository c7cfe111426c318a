"""Processes that plan, each for one piece of work at a time: one that dies takes nobody along."""
