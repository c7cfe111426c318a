"""What columns are headed in the main languages of Europe, in simple letters.

English, German, French, Spanish, Italian, Dutch, Polish, Portuguese; `|` stands between phrases.
Simple: lower case, no accents, `ss` for the sharp s of German.
"""

from app.formats.sheets.order_words import ORDER_WORDS
from app.formats.sheets.rule_words import RULE_WORDS

WINDOW = {
    "en": "time window|window|delivery window|delivery time|time slot|slot|opening hours|tw|"
          "hours|delivery hours|timeslot|time windows|windows",
    "de": "zeitfenster|lieferfenster|lieferzeit|offnungszeiten|lieferzeitfenster|uhrzeit|"
          "anlieferzeit|zeitraum|annahmezeit|warenannahme|zf|wunschzeit|wunschtermin",
    "fr": "creneau|creneau horaire|plage horaire|horaires|fenetre|horaire|horaires de livraison",
    "es": "ventana|franja horaria|horario|ventana horaria|horario de entrega|franja",
    "it": "fascia oraria|finestra|orario|fascia|orario di consegna|orari",
    "nl": "tijdvenster|venster|tijdvak|levertijd|openingstijden|bloktijd",
    "pl": "okno|okno czasowe|godziny|przedzial|godziny dostawy",
    "pt": "janela|janela horaria|horario de entrega",
}

BEGIN = {
    "en": "from|start|begin|begins|open|opens|earliest|after|starts|starting|start time|"
          "open time|opening|not before|begin time|opening time",
    "de": "von|ab|beginn|anfang|fruhestens|start|fruheste|offnet|fruh",
    "fr": "de|debut|ouverture|a partir de|des|du|au plus tot|debut a",
    "es": "desde|de|inicio|apertura|abre|comienzo",
    "it": "da|dalle|inizio|apertura|dalle ore",
    "nl": "van|vanaf|begin|open|vroegst",
    "pl": "od|poczatek|otwarcie|najwczesniej",
    "pt": "de|inicio|das|a partir de|abertura",
}

END = {
    "en": "to|until|till|end|ends|close|closes|latest|before|by|due|end time|close time|closing|"
          "due time|due date|not after|deadline|closing time|finish",
    "de": "bis|ende|spatestens|schluss|schliesst|spateste|spat",
    "fr": "a|au|fin|fermeture|jusqu a|jusque|au plus tard|jusqua|fin a",
    "es": "hasta|a|fin|cierre|cierra|final",
    "it": "a|alle|fine|chiusura|fino a|alle ore",
    "nl": "tot|t m|einde|eind|sluit|laatst",
    "pl": "do|koniec|zamkniecie|najpozniej",
    "pt": "ate|a|fim|as|fecho|encerramento",
}

WORDS: dict[str, dict[str, str]] = {
    "name": {
        "en": "name|customer|customer name|client|stop|stop name|company|recipient|consignee|"
              "shop|store|ship to|location name|id|customer id|receiver|account|site|"
              "ship to name|business|delivery name|stop id|client name|business name",
        "de": "kunde|kundenname|firma|empfanger|bezeichnung|kdname|kd name|filiale|lieferkunde|"
              "markt|name 1|name1|warenempfanger|stopp|kdn|adressat|betrieb",
        "fr": "nom|client|nom client|destinataire|societe|raison sociale|magasin|nom du client|"
              "enseigne|entreprise",
        "es": "nombre|cliente|destinatario|empresa|tienda|razon social|nombre cliente",
        "it": "nome|cliente|destinatario|ragione sociale|negozio|azienda|denominazione",
        "nl": "naam|klant|klantnaam|bedrijf|ontvanger|winkel|bedrijfsnaam",
        "pl": "nazwa|klient|odbiorca|firma|nazwa klienta|sklep|kontrahent",
        "pt": "nome|cliente|destinatario|empresa|loja",
    },
    "first_name": {
        "en": "first name|given name|forename",
        "de": "vorname",
        "fr": "prenom",
        "nl": "voornaam",
        "pl": "imie",
        "pt": "primeiro nome",
    },
    "order": {
        "en": "order|order no|order number|order id|reference|ref|po|po number|shipment|invoice|"
              "job|delivery note|no|number|consignment|order nr|shipment id|tracking number|"
              "job id|job no",
        "de": "auftrag|auftragsnr|auftragsnummer|bestellnr|bestellnummer|bestellung|"
              "lieferschein|lieferscheinnr|lieferschein nr|ls nr|auftrags nr|auftr nr|referenz|"
              "sendung|sendungsnr|belegnr|beleg|nr|lfd nr|pos|kundennr|kunden nr|kundennummer|"
              "kd nr|kdnr|bestell nr|aufnr|rechnung",
        "fr": "commande|n commande|no commande|numero|numero de commande|reference|bl|"
              "bon de livraison|num commande|n|code client|n client|num",
        "es": "pedido|n pedido|numero de pedido|num pedido|referencia|albaran|numero|codigo",
        "it": "ordine|n ordine|numero ordine|riferimento|bolla|ddt|numero|codice|codice cliente",
        "nl": "ordernummer|bestelling|ordernr|referentie|klantnummer|nummer|bestelnummer|"
              "klantnr",
        "pl": "zamowienie|nr zamowienia|numer zamowienia|numer|referencja|nr|lp|zlecenie",
        "pt": "pedido|encomenda|n pedido|numero|referencia",
    },
    "address": {
        "en": "address|full address|delivery address|ship address|location|addr|"
              "shipping address|address line|address 1|address1|stop address",
        "de": "adresse|anschrift|lieferadresse|lieferanschrift|ort und strasse|lief adr|"
              "lieferadr|lief adresse|ladestelle|standort",
        "fr": "adresse|adresse de livraison|adresse livraison|adresse complete|lieu|adr",
        "es": "direccion|domicilio|direccion de entrega|direccion completa|dir",
        "it": "indirizzo|indirizzo di consegna|luogo",
        "nl": "adres|afleveradres|bezorgadres|leveradres",
        "pl": "adres|adres dostawy|pelny adres",
        "pt": "endereco|morada|endereco de entrega",
    },
    "street": {
        "en": "street|street address|road|street name|address line 1|street 1",
        "de": "strasse|str|strasse und hausnummer|strasse nr|strasse hausnr|strasse hnr|"
              "strasse und nr",
        "fr": "rue|voie|numero et rue|rue et numero",
        "es": "calle|via|calle y numero",
        "it": "via|strada|via e numero",
        "nl": "straat|straatnaam|straat en huisnummer",
        "pl": "ulica|ul|ulica i numer",
        "pt": "rua|logradouro",
    },
    "house_number": {
        "en": "house number|house no|street number|building number|house|house nr",
        "de": "hausnummer|hausnr|hnr|haus nr|h nr",
        "fr": "numero de rue|n rue|n voie",
        "es": "num calle|portal",
        "it": "civico|numero civico|n civico",
        "nl": "huisnummer|huisnr",
        "pl": "nr domu|numer domu|dom",
        "pt": "numero da porta",
    },
    "postcode": {
        "en": "postcode|postal code|zip|zip code|zipcode|post code|postalcode",
        "de": "plz|postleitzahl",
        "fr": "cp|code postal|codepostal",
        "es": "cp|codigo postal|c p|cod postal",
        "it": "cap|codice postale|c a p",
        "nl": "postcode|pc",
        "pl": "kod pocztowy|kod",
        "pt": "cep|codigo postal",
    },
    "town": {
        "en": "town|city|place|suburb|locality|municipality",
        "de": "ort|stadt|wohnort|gemeinde|lieferort",
        "fr": "ville|commune|localite",
        "es": "ciudad|poblacion|municipio|localidad",
        "it": "citta|comune|localita",
        "nl": "plaats|stad|woonplaats|gemeente",
        "pl": "miasto|miejscowosc",
        "pt": "cidade|localidade|concelho",
    },
    "country": {
        "en": "country|country code",
        "de": "land|staat|lkz",
        "fr": "pays",
        "es": "pais",
        "it": "paese|nazione|stato",
        "nl": "land",
        "pl": "kraj",
        "pt": "pais",
    },
    "latitude": {
        "en": "latitude|lat|gps lat|latitude deg|geo lat|y coordinate wgs84",
        "de": "breite|breitengrad|geogr breite|geo breite|nordliche breite|gps breite",
        "fr": "latitude|lat gps",
        "es": "latitud",
        "it": "latitudine",
        "nl": "breedtegraad|breedte",
        "pl": "szerokosc|szer|szerokosc geograficzna|szer geogr",
        "pt": "latitude",
    },
    "longitude": {
        "en": "longitude|lon|lng|long|gps lon|gps lng|gps long|geo lon|geo lng",
        "de": "lange|langengrad|geogr lange|geo lange|ostliche lange|gps lange",
        "fr": "longitude|lon gps",
        "es": "longitud",
        "it": "longitudine",
        "nl": "lengtegraad|lengte",
        "pl": "dlugosc|dl|dlugosc geograficzna|dl geogr",
        "pt": "longitude",
    },
    "point": {
        "en": "coordinates|wkt|geometry|geom|point|coords|gps|lat lon|lat lng|latlng|lat long|"
              "latitude longitude|geo|gps coordinates|position|geolocation|lat lon coordinates|"
              "map|maps|google maps|map link|maps link|google maps link|location link|link|url|"
              "geo uri|pin",
        "de": "koordinaten|gps koordinaten|geokoordinaten|koord|karte|kartenlink|google link|"
              "standort link",
        "fr": "coordonnees|coordonnees gps",
        "es": "coordenadas",
        "it": "coordinate",
        "nl": "coordinaten|gps coordinaten",
        "pl": "wspolrzedne",
        "pt": "coordenadas",
    },
    "x": {
        "en": "x|x coord|xcoord|easting|east|x coordinate|x coord",
        "de": "rechtswert|ostwert|x wert",
    },
    "y": {
        "en": "y|y coord|ycoord|northing|north|y coordinate|y coord",
        "de": "hochwert|nordwert|y wert",
    },
    "demand": {
        "en": "demand|quantity|qty|amount|weight|load|volume|parcels|packages|boxes|pallets|"
              "pieces|units|cases|items|total weight|gross weight|crates|size|pcs|demand 1|"
              "demand 2|demand 3|cartons|pkgs|pkg|pkg count|no of packages|number of packages|"
              "ctns|plts|"
              "pallet count|parcel count|kgs|deliver|to deliver",
        "de": "menge|gewicht|anzahl|bedarf|ladung|volumen|pakete|paletten|stuck|stk|kisten|"
              "kartons|colli|kolli|bruttogewicht|gesamtgewicht|gew|vol|pal|anz|ladungsgewicht|"
              "packstucke|stellplatze|pak|kist|kart|ve|gebinde|liefermenge|sendungen",
        "fr": "quantite|poids|volume|colis|palettes|nombre de colis|nb colis|charge|qte|"
              "poids brut|nombre|cartons|nb palettes|poids total",
        "es": "cantidad|peso|volumen|bultos|paquetes|cajas|palets|carga|cant|demanda|unidades",
        "it": "quantita|peso|volume|colli|pacchi|bancali|pallet|carico|qta|peso lordo|domanda",
        "nl": "hoeveelheid|aantal|gewicht|volume|pakketten|dozen|pallets|colli|lading|vraag",
        "pl": "ilosc|waga|ciezar|objetosc|paczki|palety|ladunek|masa|liczba|sztuki",
        "pt": "quantidade|peso|volume|pacotes|caixas|paletes|carga|volumes|qtd",
    },
    "service": {
        "en": "service|service time|service duration|duration|stop time|unloading time|"
              "unload time|handling time|dwell|dwell time|time at stop|stop duration|"
              "visit duration|unloading|unload|time on site|serv time|drop time|work time|handling|"
              "time needed|minutes at stop",
        "de": "dauer|servicezeit|entladezeit|standzeit|haltezeit|abladezeit|aufenthalt|"
              "entladedauer|servicedauer|stoppzeit|entladung|bedienzeit|verweildauer|"
              "aufenthaltsdauer|ladezeit|abladen|entladen|ausladen|zeitbedarf|einsatzdauer",
        "fr": "duree|dechargement|temps|temps de service|"
              "temps sur place|duree d arret|temps de dechargement|"
              "duree de service|temps d arret|duree arret",
        "es": "duracion|descarga|tiempo de servicio|tiempo de descarga|servicio|tiempo de parada",
        "it": "durata|scarico|"
              "tempo di servizio|tempo di scarico|servizio|sosta|tempo sosta|tempo scarico",
        "nl": "duur|lossen|lostijd|servicetijd|stoptijd|lostijden|verblijftijd",
        "pl": "czas obslugi|czas trwania|czas rozladunku|obsluga|czas postoju",
        "pt": "duracao|tempo de servico|tempo de descarga|servico",
    },
    "ready": {
        "en": "ready|ready time|release|release time|available from|goods ready|released|"
              "ready date",
        "de": "bereit|bereit ab|verfugbar ab|abholbereit|bereitstellung|fertig ab",
        "fr": "disponible|pret|disponible a partir de|pret a partir de",
        "es": "disponible desde|listo",
        "it": "disponibile da|pronto",
        "nl": "gereed|beschikbaar vanaf",
        "pl": "gotowe|dostepne od",
        "pt": "disponivel desde|pronto",
    },
    "date": {
        "en": "date|delivery date|ship date|day|delivery day|route date|scheduled date|"
              "requested date",
        "de": "datum|liefertag|lieferdatum|tag|termin|liefertermin|wunschtermin|tourdatum",
        "fr": "date|date de livraison|jour|date livraison",
        "es": "fecha|fecha de entrega|dia",
        "it": "data|data di consegna|giorno|data consegna",
        "nl": "datum|leverdatum|dag|bezorgdatum",
        "pl": "data|data dostawy|dzien",
        "pt": "data|data de entrega|dia",
    },
    "unassigned_cost": {
        "en": "unassigned cost|cost of leaving out|penalty|prize|value of order|revenue|"
              "drop cost",
        "de": "strafe|strafkosten|erlos|umsatz|kosten bei ausfall",
        "fr": "penalite|recette",
        "es": "penalizacion|ingreso",
        "it": "penale|ricavo",
        "nl": "boete|opbrengst",
        "pl": "kara|przychod",
        "pt": "penalidade|receita",
    },
    "late_cost": {
        "en": "late cost per hour|late cost|cost per hour late",
        "de": "verspatungskosten|kosten je stunde verspatung",
    },
    "early_cost": {
        "en": "early cost per hour|early cost|cost per hour early|waiting cost",
        "de": "wartekosten",
    },
    "served_by": {
        "en": "served by|drone|drone allowed|by drone|drone ok|drone possible|drone delivery|"
              "mode",
        "de": "drohne|drohne erlaubt|drohne moglich|per drohne|drohne ok|drohnenlieferung",
        "fr": "drone|drone autorise|par drone|drone possible",
        "es": "dron|dron permitido|con dron",
        "it": "drone|drone consentito",
        "nl": "drone|drone toegestaan",
        "pl": "dron|dron dozwolony",
        "pt": "drone|drone permitido",
    },
    "skills": {
        "en": "skills|skill|requires|requirements|equipment|required skills|needs|"
              "required equipment",
        "de": "anforderungen|ausstattung|qualifikation|benotigt|hebebuhne|erfordert|anforderung",
        "fr": "competences|equipement|exigences|besoins",
        "es": "requisitos|equipo|habilidades",
        "it": "requisiti|attrezzatura|competenze",
        "nl": "vereisten|uitrusting|eisen",
        "pl": "wymagania|wyposazenie",
        "pt": "requisitos|equipamento",
    },
    "vehicles": {
        "en": "vehicles|vehicle|allowed vehicles|vehicles allowed|vehicle type|truck|van|"
              "vehicle types|required vehicle",
        "de": "fahrzeug|fahrzeuge|fahrzeugtyp|lkw|fahrzeugtypen|fzg|fahrzeugart",
        "fr": "vehicule|vehicules",
        "es": "vehiculo|vehiculos",
        "it": "veicolo|veicoli|mezzo",
        "nl": "voertuig|voertuigen",
        "pl": "pojazd|pojazdy",
        "pt": "veiculo|veiculos",
    },
    "forbidden_vehicles": {
        "en": "forbidden vehicles|vehicles forbidden|not by|vehicles not allowed",
        "de": "verbotene fahrzeuge|nicht mit",
    },
    "kind": {
        "en": "kind|type|stop type|order type|job type|service type|activity|pickup|"
              "pick up|collection|return",
        "de": "art|typ|stopptyp|auftragsart|vorgang|vorgangsart|auftragstyp|tatigkeit|abholung|"
              "retoure|abholauftrag",
        "fr": "type",
        "es": "tipo",
        "it": "tipo",
        "nl": "soort",
        "pl": "typ|rodzaj",
        "pt": "tipo",
    },
    "phone": {
        "en": "phone|telephone|tel|mobile|phone number|cell|cell phone|contact number|phone no|"
              "mobile no",
        "de": "telefon|telefonnummer|handy|mobil|tel nr|telefonnr|rufnummer|mobilnummer|fon",
        "fr": "telephone|portable|tel portable|numero de telephone|mobile",
        "es": "telefono|movil|tlf|tfno",
        "it": "telefono|cellulare|cell",
        "nl": "telefoon|telefoonnummer|mobiel|gsm",
        "pl": "telefon|nr telefonu|komorka",
        "pt": "telefone|telemovel|celular",
    },
    "email": {
        "en": "email|e mail|mail|email address",
        "de": "e mail adresse|mailadresse",
        "fr": "courriel|mel",
        "es": "correo|correo electronico",
        "it": "posta elettronica",
        "nl": "e mailadres|mailadres",
        "pl": "adres e mail",
        "pt": "correio eletronico",
    },
    "contact": {
        "en": "contact|contact name|contact person|attention|attn",
        "de": "ansprechpartner|kontakt|kontaktperson|z hd|ansprechperson",
        "fr": "contact|interlocuteur",
        "es": "contacto|persona de contacto",
        "it": "contatto|referente",
        "nl": "contactpersoon",
        "pl": "osoba kontaktowa|kontakt",
        "pt": "contacto|contato",
    },
    "notes": {
        "en": "notes|note|comment|comments|remark|remarks|instructions|instruction|info|"
              "information|delivery notes|delivery instructions|special instructions|"
              "driver notes|description",
        "de": "bemerkung|bemerkungen|hinweis|hinweise|notiz|notizen|kommentar|anmerkung|"
              "fahrerhinweis|lieferhinweis|bem|infos|zusatzinfo|fahrerinfo|zusatz|beschreibung|"
              "anmerkungen",
        "fr": "remarque|remarques|commentaire|commentaires|consignes|observations|instructions|"
              "obs",
        "es": "notas|observaciones|comentarios|instrucciones|nota|comentario|obs",
        "it": "note|osservazioni|commenti|istruzioni|nota",
        "nl": "opmerking|opmerkingen|notitie|instructies",
        "pl": "uwagi|notatki|komentarz|informacje|uwaga",
        "pt": "notas|observacoes|comentarios|obs",
    },
    "priority": {
        "en": "priority|prio|importance|urgent|vip",
        "de": "prioritat|wichtigkeit|dringlichkeit|eilig",
        "fr": "priorite|urgence",
        "es": "prioridad",
        "it": "priorita",
        "nl": "prioriteit",
        "pl": "priorytet",
        "pt": "prioridade",
    },
    **ORDER_WORDS,
    **RULE_WORDS,
    "window": WINDOW,
    "earliest": BEGIN,
    "latest": END,
}
