"""What columns of preferred vehicles, and of who goes with whom, are headed, as in `words`."""

RULE_WORDS: dict[str, dict[str, str]] = {
    "preferred_vehicles": {
        "en": "preferred vehicle|preferred vehicles|preferred driver|regular driver|usual driver|"
              "regular vehicle|usual vehicle|preferred van|preferred truck",
        "de": "stammfahrer|stammfahrzeug|wunschfahrer|wunschfahrzeug|bevorzugtes fahrzeug|"
              "bevorzugter fahrer|bevorzugte fahrzeuge|ublicher fahrer",
        "fr": "chauffeur habituel|vehicule habituel|chauffeur prefere|vehicule prefere|"
              "conducteur habituel",
        "es": "conductor habitual|vehiculo habitual|conductor preferido|vehiculo preferido",
        "it": "autista abituale|veicolo abituale|autista preferito|veicolo preferito|"
              "mezzo preferito",
        "nl": "vaste chauffeur|vast voertuig|voorkeurschauffeur|voorkeursvoertuig",
        "pl": "staly kierowca|staly pojazd|preferowany kierowca|preferowany pojazd",
        "pt": "motorista habitual|veiculo habitual|motorista preferido|veiculo preferido",
    },
    "preference_cost": {
        "en": "preference cost|cost of another vehicle|cost of other vehicle|"
              "cost of another driver|other vehicle cost|other driver cost",
        "de": "kosten anderes fahrzeug|kosten anderer fahrer|kosten bei anderem fahrzeug|"
              "kosten bei anderem fahrer",
        "fr": "cout autre vehicule|cout autre chauffeur",
        "es": "coste otro vehiculo|coste otro conductor",
        "it": "costo altro veicolo|costo altro autista",
        "nl": "kosten ander voertuig|kosten andere chauffeur",
        "pl": "koszt innego pojazdu|koszt innego kierowcy",
        "pt": "custo outro veiculo|custo outro motorista",
    },
    "together": {
        "en": "goes with|together with|together|same vehicle|same vehicle as|keep together",
        "de": "zusammen mit|zusammen|gemeinsam mit|gleiches fahrzeug|gleiches fahrzeug wie|"
              "selbes fahrzeug",
        "fr": "ensemble avec|livrer avec|meme vehicule|meme vehicule que",
        "es": "junto con|va con|mismo vehiculo|mismo vehiculo que",
        "it": "insieme a|insieme con|stesso veicolo|stesso veicolo di",
        "nl": "samen met|zelfde voertuig|zelfde voertuig als",
        "pl": "razem z|ten sam pojazd",
        "pt": "junto com|vai com|mesmo veiculo|mesmo veiculo que",
    },
    "apart": {
        "en": "not with|not together|not together with|keep apart|keep apart from|apart from|"
              "separate from|not same vehicle|different vehicle",
        "de": "nicht zusammen|nicht zusammen mit|nicht gemeinsam mit|getrennt von|trennen von|"
              "anderes fahrzeug als",
        "fr": "pas avec|ne pas livrer avec|pas ensemble|separe de|autre vehicule que",
        "es": "no con|no junto con|separado de|otro vehiculo que",
        "it": "non con|non insieme a|separato da|altro veicolo di",
        "nl": "niet met|niet samen met|gescheiden van|ander voertuig dan",
        "pl": "nie z|nie razem z|osobno od|inny pojazd niz",
        "pt": "nao com|nao junto com|separado de|outro veiculo que",
    },
    "before": {
        "en": "served before|visit before|must be before|before customer|before stop",
        "de": "vor kunde|beliefern vor|liefern vor|muss vor|kommt vor",
        "fr": "livrer avant|a livrer avant|avant client",
        "es": "antes de|entregar antes de",
        "it": "prima di|consegnare prima di",
        "nl": "komt voor|leveren voor",
        "pl": "przed klientem|dostarczyc przed",
        "pt": "antes de|entregar antes de",
    },
    "after": {
        "en": "served after|visit after|must be after|after customer|after stop|follows|"
              "predecessor|depends on",
        "de": "nach kunde|beliefern nach|liefern nach|muss nach|kommt nach|vorganger",
        "fr": "livrer apres|a livrer apres|apres client",
        "es": "despues de|entregar despues de",
        "it": "dopo di|consegnare dopo",
        "nl": "komt na|leveren na",
        "pl": "po kliencie|dostarczyc po",
        "pt": "depois de|entregar depois de",
    },
    "shipment": {
        "en": "shipment pair|pair|pair id|transport order|transport id",
        "de": "transport|transportauftrag|transportnr|transportnummer|umfuhre",
        "fr": "transport|ordre de transport",
        "es": "orden de transporte",
        "it": "ordine di trasporto",
        "nl": "transportopdracht",
        "pl": "zlecenie transportowe",
        "pt": "ordem de transporte",
    },
    "max_between": {
        "en": "max ride time|maximum ride time|max time between|longest ride|max transit time",
        "de": "max fahrzeit|maximale fahrzeit|hochstdauer unterwegs|max transportdauer",
        "fr": "duree max de trajet|temps de trajet max",
        "es": "tiempo maximo de viaje",
        "it": "tempo massimo di viaggio",
        "nl": "maximale reistijd",
        "pl": "maksymalny czas przejazdu",
        "pt": "tempo maximo de viagem",
    },
    "alternative_to": {
        "en": "alternative to|alternative for|instead of|alternative of",
        "de": "alternative zu|alternativ zu|ersatz fur|anstelle von",
        "fr": "alternative a|au lieu de|a la place de",
        "es": "alternativa a|en lugar de",
        "it": "alternativa a|al posto di|invece di",
        "nl": "alternatief voor|in plaats van",
        "pl": "zamiast",
        "pt": "alternativa a|em vez de",
    },
    "alternative_cost": {
        "en": "alternative cost|cost of alternative|cost of other place|locker cost",
        "de": "kosten alternative|kosten ausweichort|alternativkosten",
        "fr": "cout alternative",
        "es": "coste alternativa",
        "it": "costo alternativa",
        "nl": "kosten alternatief",
        "pl": "koszt alternatywy",
        "pt": "custo alternativa",
    },
}
