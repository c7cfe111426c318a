"""How the database's tables come from one version to the next, with Alembic."""
