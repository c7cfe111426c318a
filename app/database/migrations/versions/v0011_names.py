"""What people call the vehicle of a driver's link."""

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"


def upgrade() -> None:
    """Add the column; vehicles of links that are there are called by their ids."""
    op.add_column("driver_links", sa.Column("name", sa.Text))


def downgrade() -> None:
    """Drop the column."""
    op.drop_column("driver_links", "name")
