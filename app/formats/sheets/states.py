"""What people write of an order's state, in simple letters."""

from app.formats.sheets.words import STATE_WORDS

CANCELLED, DONE, OPEN, NOT = (
    frozenset(STATE_WORDS[name]) for name in ("cancelled", "done", "open", "not"))

STATES = frozenset(word for text in CANCELLED | DONE | OPEN for word in text.split())
