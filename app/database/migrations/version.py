"""Where a database says which version its tables have."""

VERSION_TABLE = "tandem_version"
