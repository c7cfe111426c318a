"""What a job waits for that can't begin yet, since when, and when it is tried again."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Add the columns; no job waits yet."""
    op.add_column("jobs", sa.Column("waiting_for", sa.Text))
    op.add_column("jobs", sa.Column("waiting_since", sa.BigInteger))
    op.add_column("jobs", sa.Column("retry_at", sa.BigInteger))


def downgrade() -> None:
    """Drop the columns."""
    op.drop_column("jobs", "retry_at")
    op.drop_column("jobs", "waiting_since")
    op.drop_column("jobs", "waiting_for")
