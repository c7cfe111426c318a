"""Spreadsheets of customers -> requests of `POST /plan`, with every guess told."""
