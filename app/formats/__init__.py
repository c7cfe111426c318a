"""Requests and problems in other forms: spreadsheets, files of instances, VROOM's."""
