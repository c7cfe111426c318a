"""Kept plans that are a day's."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"


def upgrade() -> None:
    """Add the column; plans that are there are no day's."""
    op.add_column("kept_plans", sa.Column("day", sa.String(36)))


def downgrade() -> None:
    """Drop the column: such plans stay as they were when they were kept."""
    op.drop_column("kept_plans", "day")
