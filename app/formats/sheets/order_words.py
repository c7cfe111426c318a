"""What columns of states, of pickups and of regions are headed, as in `words`."""

ORDER_WORDS: dict[str, dict[str, str]] = {
    "region": {
        "en": "state|province|county|region|state province|us state",
        "de": "bundesland|kanton|region|provinz",
        "fr": "departement|region|province|canton",
        "es": "provincia|comunidad autonoma|region",
        "it": "provincia|prov|regione",
        "nl": "provincie",
        "pl": "wojewodztwo",
        "pt": "distrito|estado|uf",
    },
    "status": {
        "en": "status|order status|state|order state|cancelled|canceled",
        "de": "status|auftragsstatus|zustand|storno|storniert|bearbeitungsstand",
        "fr": "statut|etat|annule",
        "es": "estado|situacion|anulado",
        "it": "stato|annullato",
        "nl": "status|geannuleerd",
        "pl": "status|stan",
        "pt": "situacao|status",
    },
    "pickup": {
        "en": "pickup|pick up|pickup quantity|pickup qty|collection|returns|empties|pick up qty|"
              "pickup amount|quantity to pick up|to collect|return quantity",
        "de": "abholmenge|retouren|leergut|abzuholen|abholung menge|menge abholung|rucknahme|"
              "retourmenge|ruckgabe|abholgewicht|leergutmenge",
        "fr": "retours|a enlever|quantite a enlever|consignes vides|reprise|quantite enlevement",
        "es": "recogidas|devoluciones|cantidad a recoger",
        "it": "resi|ritiri|da ritirare|quantita da ritirare",
        "nl": "retouren|retour|emballage|op te halen",
        "pl": "zwroty|do odbioru",
        "pt": "devolucoes|recolhas",
    },
}
