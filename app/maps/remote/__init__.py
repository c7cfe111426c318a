"""Asking what others know over HTTP."""
