"""What columns of a sheet with vehicles are headed."""

WORDS = {
    "name": "fahrzeug|fahrzeuge|kennzeichen|vehicle|vehicles|van|truck|lkw|wagen|fzg|plate|"
            "license plate|licence plate|registration|auto|vehicule|vehicules|camion|camions|"
            "immatriculation|vehiculo|vehiculos|matricula|veicolo|veicoli|mezzo|targa|voertuig|"
            "kenteken|pojazd|veiculo|fahrzeugtyp|vehicle type|transporter",
    "driver": "fahrer|driver|chauffeur|conducteur|conductor|autista|kierowca|motorista",
    "count": "anzahl|count|number|stuck|how many|nombre|numero|cantidad|quantita|aantal|ilosc",
    "capacity": "kapazitat|capacity|nutzlast|zuladung|payload|max load|load|capacite|"
                "charge utile|capacidad|capacita|portata|capaciteit|laadvermogen|ladownosc|"
                "max gewicht|max weight|stellplatze|ladevolumen|volume|volumen",
    "earliest": "von|ab|from|start|begin|beginn|dienstbeginn|schichtbeginn|shift start|start time|"
                "debut|de|desde|inicio|dalle|vanaf|od|arbeitsbeginn|schicht von|dienst von|"
                "schicht ab|arbeitszeit von|shift from|shift begin|works from",
    "latest": "bis|to|until|end|ende|dienstende|schichtende|shift end|end time|fin|a|hasta|alle|"
              "tot|do|arbeitsende|feierabend|schicht bis|dienst bis|arbeitszeit bis|shift to|"
              "shift until|works until",
    "window": "schicht|shift|arbeitszeit|dienst|working hours|hours|dienstzeit|horaire|turno|"
              "orario|einsatzzeit",
    "speed": "geschwindigkeit|speed|tempo|vitesse|velocidad|velocita|km h|kmh",
    "per_km": "kosten km|kosten pro km|cost per km|euro km|eur km|per km|km kosten|cout km|"
              "km cost|cost km",
    "per_hour": "kosten stunde|kosten pro stunde|stundensatz|stundenlohn|cost per hour|hourly rate|"
                "eur h|per hour|cout heure|kosten h|eur std|hour cost|cost hour",
    "fixed": "fixkosten|tagessatz|fixed cost|fixed|daily rate|grundkosten|cout fixe",
    "max_trips": "touren|fahrten|max touren|max trips|trips|rotations|max fahrten",
    "skills": "ausstattung|skills|equipment|merkmale|eigenschaften|equipement|hebebuhne|kuhlung",
    "drones": "drohnen|drones|drone|drohne",
    "break": "pause|pausen|mittagspause|pausenfenster|pausenzeit|break|breaks|lunch|lunch break|"
             "break window|break time|pause dejeuner|descanso|pausa|pausa pranzo|pauze|lunchpauze|"
             "przerwa|intervalo",
    "break_duration": "pausendauer|pausenlange|dauer der pause|break duration|break length|"
                      "length of break|duree de la pause|duree pause|duracion del descanso|"
                      "durata pausa|pauzeduur|czas przerwy|duracao da pausa",
    "break_within": "pause spatestens nach|pause innerhalb|break within|break after at most|"
                    "break at the latest after",
    "break_paid": "pause bezahlt|bezahlte pause|break paid|paid break|pause payee|pausa pagata",
    "break_anywhere": "pause unterwegs|pause uberall|break anywhere|break on the way",
    "break_max_load": "pause beladung bis|hochste ladung bei pause|break max load|"
                      "max load at break|most aboard at break",
    "max_work": "max arbeitszeit|maximale arbeitszeit|hochstarbeitszeit|max hours|max working time|"
                "max work|longest working time|max duty|duree max de travail|max jornada|"
                "orario massimo|max werktijd",
    "max_travel": "max fahrzeit|maximale fahrzeit|max driving|max driving time|longest driving|"
                  "max travel time|conduite max|max rijtijd",
    "driving_rules": "lenkzeiten|lenkregel|lenkregeln|lenkzeitregel|lenk und ruhezeiten|"
                     "driving rules|driver rules|hours of service|hos|temps de conduite|"
                     "tiempos de conduccion|tempi di guida|rijtijden",
    "max_driving": "lenkzeit bis pause|lenkzeit ohne pause|max lenkzeit ohne pause|"
                   "driving before break|driving before rest|max driving before break|"
                   "max driving without break",
    "max_work_before_break": "arbeitszeit bis pause|arbeitszeit ohne pause|work before break|"
                             "work before rest|max work before break|max work without break",
    "max_driving_per_day": "lenkzeit am tag|lenkzeit pro tag|tageslenkzeit|driving per day|"
                           "max driving per day|daily driving",
    "rest": "lenkpause|ruhepause|ruhezeit|rest|rest duration|length of rest",
    "rest_split": "geteilte lenkpause|lenkpause geteilt|split rest|rest split|rest in parts",
    "driven_before": "bereits gefahren|lenkzeit bisher|driven before|driven already|driving so far",
    "worked_before": "bereits gearbeitet|arbeitszeit bisher|worked before|worked already|"
                     "work so far",
    "lifo": "lifo|last in first out|nur zuletzt geladenes|zuletzt geladen zuerst entladen",
}
"""Headings of columns, in simple letters; `|` stands between phrases."""
