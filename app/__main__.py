"""`python -m app` is the command `tandem`."""

from app.cli import main

if __name__ == "__main__":
    main()
