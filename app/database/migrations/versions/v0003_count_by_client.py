"""An index from which alone open plans are counted, whatever else the jobs' rows hold."""

from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Put a longer index in place of that by state."""
    op.create_index("jobs_by_client", "jobs", ["state", "parent", "client", "plans"])
    op.drop_index("jobs_by_state", "jobs")


def downgrade() -> None:
    """Put the former one back."""
    op.create_index("jobs_by_state", "jobs", ["state"])
    op.drop_index("jobs_by_client", "jobs")
