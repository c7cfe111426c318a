"""The service's own database: connections, tables, and the versions that these came through."""
