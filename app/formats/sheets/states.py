"""What people write of an order's state, in simple letters."""

CANCELLED = frozenset((
    "storno", "storniert", "stornierung", "storniert!", "abgesagt", "annulliert", "entfallt",
    "entfallen", "cancelled", "canceled", "cancel", "cancellation", "void", "annule", "annulee",
    "annulation", "anulado", "anulada", "cancelado", "cancelada", "annullato", "annullata",
    "cancellato", "geannuleerd", "anulowane", "anulowano", "anulowany"))
DONE = frozenset((
    "geliefert", "ausgeliefert", "zugestellt", "erledigt", "abgeschlossen", "delivered", "done",
    "completed", "complete", "closed", "finished", "livre", "livree", "termine", "entregado",
    "completado", "consegnato", "completato", "afgeleverd", "geleverd", "bezorgd", "dostarczono",
    "dostarczone", "entregue"))
OPEN = frozenset((
    "offen", "neu", "bestatigt", "geplant", "frei", "freigegeben", "aktiv", "bereit", "ok", "open",
    "new", "confirmed", "planned", "active", "ready", "pending", "scheduled", "to deliver",
    "ouvert", "nouveau", "confirme", "a livrer", "en cours", "abierto", "nuevo", "confirmado",
    "pendiente", "aperto", "nuovo", "confermato", "nieuw", "bevestigd", "nowe", "otwarte",
    "potwierdzone", "aberto", "novo", "in bearbeitung", "in progress", "disponiert"))

STATES = frozenset(word for text in CANCELLED | DONE | OPEN for word in text.split())
