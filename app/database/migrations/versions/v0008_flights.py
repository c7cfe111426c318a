"""Flights of the drones that a driver's link is for."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"


def upgrade() -> None:
    """Add the column; links that are there tell of no flights."""
    op.add_column("driver_links", sa.Column("flights", sa.LargeBinary))


def downgrade() -> None:
    """Drop the column."""
    op.drop_column("driver_links", "flights")
