"""What Alembic runs for each command: the caller's transaction holds all that it does."""

from alembic import context

from app.database.migrations.version import VERSION_TABLE

context.configure(connection=context.config.attributes["connection"], version_table=VERSION_TABLE)
context.run_migrations()
