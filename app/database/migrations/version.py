"""Where a database says which version its tables have."""

from typing import Literal

from sqlalchemy import Column, MetaData, PrimaryKeyConstraint, String, Table

Direction = Literal["upgrade", "downgrade"]

VERSION_TABLE = "tandem_version"

STATED = Table(VERSION_TABLE, MetaData(), Column("version_num", String(32), nullable=False),
               PrimaryKeyConstraint("version_num", name=f"{VERSION_TABLE}_pkc"))
"""As Alembic makes it."""
