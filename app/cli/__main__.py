"""`python -m app.cli` is the command `tandem`."""

from app.cli.commands import main

if __name__ == "__main__":
    main()
