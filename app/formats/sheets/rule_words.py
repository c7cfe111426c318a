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
}
