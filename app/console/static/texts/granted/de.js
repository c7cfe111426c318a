/** Was beim Einlesen angenommen wird oder unbrauchbar ist, nach Kennungen und Werten des Dienstes. */

export default {
  ADDRESSES_PENDING:
    'Bisher sind {{known}} von {{asked}} Adressen nachgeschlagen: Datei nochmals öffnen.',
  ADDRESS_AMBIGUOUS: '„{{address}}“ ist mehrdeutig: Ort oder Postleitzahl ergänzen.',
  ADDRESS_FAR: '„{{address}}“ liegt weit von allen anderen: {{place}}.',
  ADDRESS_INEXACT: '„{{address}}“ ist nur ungefähr gefunden: {{place}}.',
  ADDRESS_NEAREST:
    '„{{address}}“ ist mehrdeutig; es gilt, was den anderen am nächsten liegt: {{place}}.',
  ADDRESS_NOT_FOUND:
    '„{{address}}“ ist nicht zu finden: berichtigen oder Breite und Länge angeben.',
  ALTERNATIVE: 'Der andere Ort gehört zu keinem Kunden, oder ihm fehlt etwas.',
  ANSWER: '„{{value}}“ ist keine der möglichen Antworten.',
  BALANCE_INCOMPLETE:
    'Auf {{sheet}} fehlt, was ausgeglichen wird oder was es kostet: Nichts wird ausgeglichen.',
  BREAKS_ASSUMED_length:
    'Pausen ohne Dauer: Ein Fenster bis zu einer Stunde ist die Pause, in längeren dauert sie {{minutes}} min.',
  BREAKS_ASSUMED_time: 'Pausen ohne Zeit: Sie beginnen höchstens {{hours}} h nach der Abfahrt.',
  CAPACITY:
    'Bei der Kapazität stehen {{numbers}} Zahlen, und es gibt {{amounts}} Mengen: Geben Sie für jede eine an.',
  CAPACITY_ASSUMED: 'Keine Kapazität angegeben: Jedes Fahrzeug fasst alles.',
  CREWS:
    'Wer {{names}} verlangt, wird von Fahrzeugen mit dieser Mannschaft oder mehr bedient, wie in {{cell}}.',
  DATES_GUESSED_month:
    '{{cell}} ({{value}}) kann mit Tag oder Monat beginnen: Der Monat steht vorn.',
  DATES_GUESSED_day: '{{cell}} ({{value}}) kann mit Tag oder Monat beginnen: Der Tag steht vorn.',
  DECIMALS_GUESSED_comma:
    '{{cell}} ({{value}}) kann Dezimalen oder Tausender haben: Das Komma steht vor Dezimalen.',
  DECIMALS_GUESSED_point:
    '{{cell}} ({{value}}) kann Dezimalen oder Tausender haben: Der Punkt steht vor Dezimalen.',
  DECIMAL_COMMAS:
    'Zeilen haben mehr Zellen als Überschriften, wie {{cell}}: Kommas zwischen Zahlen gelten als Dezimalkommas.',
  DEGREES_GUESSED: 'x und y sehen wie Grade aus: x gilt als Länge, y als Breite.',
  DEPOT: 'Es gibt kein brauchbares Depot: Geben Sie an, wo es liegt, die Breite zuerst.',
  DEPOT_lost:
    'Das Depot „{{depot}}“ ist nicht zu finden: berichtigen oder Breite und Länge angeben.',
  DEPOT_ASSUMED: 'Kein Depot angegeben: Es gilt die Mitte der Kunden, {{place}}.',
  DEPOT_BY_HAND:
    'Die Adresse des Depots wird hier nicht nachgeschlagen: Geben Sie an, wo es liegt.',
  DEPOT_FOUND: 'Das Depot ist gefunden: {{place}}.',
  DEPOT_IN_FILE_one: '{{cells}} ist das Depot und kein Kunde.',
  DEPOT_IN_FILE_other: '{{cells}} sind Depots und keine Kunden.',
  DIGITS_LOST_one:
    'Spalte {{column}}: {{count}} Zahl hat eine Tabellenkalkulation gekürzt, {{cell}} ({{value}}): Ihre letzten Ziffern sind verloren.',
  DIGITS_LOST_other:
    'Spalte {{column}}: {{count}} Zahlen hat eine Tabellenkalkulation gekürzt, wie {{cell}} ({{value}}): Ihre letzten Ziffern sind verloren.',
  DRIVING_RULES: 'Lenkregeln von Fahrzeugen widersprechen sich oder sind unvollständig.',
  DRONE_CAPACITY: 'Es gibt Drohnen: Geben Sie an, was eine trägt.',
  EMPTY_AMOUNT_one: 'Spalte {{column}}: {{count}} Zelle ist leer, {{cell}}: Sie zählt 0.',
  EMPTY_AMOUNT_other: 'Spalte {{column}}: {{count}} Zellen sind leer, wie {{cell}}: Sie zählen 0.',
  ENCODING_GUESSED:
    'Die Datei nennt ihre Kodierung nicht: Es gilt {{encoding}}. Prüfen Sie, ob „{{example}}“ richtig geschrieben ist.',
  ENDS_BEFORE: 'Das Fenster endet ({{end}}), bevor es beginnt ({{begin}}).',
  FAR_OFF: '{{cell}} liegt {{kilometres}} km von der Mitte der Kunden: Prüfen Sie die Koordinaten.',
  FLEET_ASSUMED_one: 'Keine Zahl der Fahrzeuge angegeben: {{count}} angenommen.',
  FLEET_ASSUMED_other: 'Keine Zahl der Fahrzeuge angegeben: {{count}} angenommen.',
  FLEET_IN_FILE_one: 'Die Fahrzeuge stehen auf dem Blatt {{sheet}}: {{count}} Zeile.',
  FLEET_IN_FILE_other: 'Die Fahrzeuge stehen auf dem Blatt {{sheet}}: {{count}} Zeilen.',
  FLEET_NAMED: 'Die Fahrzeuge sind die, die Aufträge nennen: {{names}}.',
  FLEET_UNUSED: 'Vom Blatt {{sheet}} werden Spalten nicht verwendet: {{names}}.',
  GEOCODER: 'Adressen lassen sich jetzt nicht nachschlagen: Versuchen Sie es später.',
  HALF_PAIR: 'Spalte {{column}} ist ein halbes Paar: Das andere fehlt.',
  HOURS_ASSUMED:
    'Was Fahrer kosten, ist nicht angegeben: Eine Stunde kostet {{amount}}, und wer überhaupt fährt, eine mehr.',
  KILOMETRES_ASSUMED: 'Was ein Kilometer kostet, ist nicht angegeben: {{amount}} angenommen.',
  LAG_WITHOUT_ORDER_one:
    '{{count}} Zeile nennt eine Zeit zwischen zweien, {{cell}}, aber nicht, wer vorher kommt: Sie gilt nicht.',
  LAG_WITHOUT_ORDER_other:
    '{{count}} Zeilen nennen eine Zeit zwischen zweien, wie {{cell}}, aber nicht, wer vorher kommt: Sie gilt nicht.',
  MAYBE_SWAPPED: 'Vertauscht lägen die Orte in Europa: Prüfen Sie Breite und Länge.',
  MEANING_BY_CONTENT: 'Spalte {{column}} ist nur nach ihren Zellen verstanden: {{meaning}}.',
  MIDNIGHT: 'Zeiten zählen ab Mitternacht.',
  MISREAD: '„{{value}}“ ist nicht zu lesen als: {{meaning}}.',
  MISREAD_amount: '„{{value}}“ ist keine Menge, oder in anderer Einheit als die Spalte.',
  MISREAD_aside: '„{{value}}“ ist nicht zu lesen.',
  MISREAD_clock: '„{{value}}“ ist keine Uhrzeit: Schreiben Sie sie wie 8:30 ({{meaning}}).',
  MISREAD_date: '„{{value}}“ ist kein Datum: Schreiben Sie es wie 23.11.2026.',
  MISREAD_degrees:
    '„{{value}}“ ist keine Zahl in Grad: Schreiben Sie sie wie 48,137 ({{meaning}}).',
  MISREAD_duration: '„{{value}}“ ist keine Dauer: Schreiben Sie sie wie 10 min ({{meaning}}).',
  MISREAD_number: '„{{value}}“ ist keine Zahl ({{meaning}}).',
  MISREAD_prices: '„{{value}}“ ist kein Fahrzeug mit Preis: Schreiben Sie es wie van-1: 5.',
  MISREAD_windows: '„{{value}}“ ist kein Zeitfenster: Schreiben Sie es wie 8:00-10:00.',
  NAMES_REPEAT_one:
    '{{count}} Stopp heißt wie ein anderer an anderem Ort oder zu anderer Zeit und bekommt einen eigenen Namen: {{cell}}, jetzt „{{name}}“.',
  NAMES_REPEAT_other:
    '{{count}} Stopps heißen wie ein anderer an anderem Ort oder zu anderer Zeit und bekommen eigene Namen, wie {{cell}}, jetzt „{{name}}“.',
  NEXT_NIGHT_one: '{{count}} Fenster gilt am Tag danach, weil vorher niemand arbeitet: {{cell}}.',
  NEXT_NIGHT_other:
    '{{count}} Fenster gelten am Tag danach, weil vorher niemand arbeitet, wie {{cell}}.',
  NO_AMOUNTS: 'Keine Spalte hat Mengen: Jeder Kunde zählt 1.',
  NO_COORDINATES_neither: 'Die Zeile hat weder Koordinaten noch eine Adresse.',
  NO_COORDINATES_row:
    'Die Zeile hat keine Koordinaten, und Adressen werden hier nicht nachgeschlagen: Geben Sie Breite und Länge an.',
  NO_COORDINATES_zero: '0, 0 liegt im Meer vor Afrika: Geben Sie Breite und Länge des Kunden an.',
  NO_COORDINATES_addresses:
    'Keine Spalten haben Koordinaten, und Adressen werden hier nicht nachgeschlagen: Ergänzen Sie Breite und Länge.',
  NO_COORDINATES_columns:
    'Keine Spalten haben Koordinaten: Sagen Sie, welche Breite und Länge sind, oder x und y.',
  NO_CUSTOMERS: 'In der Datei ist kein Kunde.',
  NO_DRONES_one: '{{count}} Kunde ist nur für Drohnen, und es gibt keine.',
  NO_DRONES_other: '{{count}} Kunden sind nur für Drohnen, und es gibt keine.',
  NO_HEADINGS: 'Es gibt keine Überschriften: Sagen Sie, was Spalten bedeuten.',
  NOT_USED:
    'Spalte {{column}} wird nicht verwendet: Die Überschrift sagt {{meaning}}, ihre Zellen nicht, oder es gibt schon eine.',
  NOT_USED_times:
    'Spalte {{column}} hat Zeiten wie {{value}} und wird nicht verwendet: Sagen Sie, was sie bedeutet.',
  OFF_GLOBE: '{{latitude}} ist keine Breite oder {{longitude}} keine Länge.',
  OTHER_DAYS_one: '{{count}} Zeile eines anderen Tages ist weggelassen.',
  OTHER_DAYS_other: '{{count}} Zeilen anderer Tage sind weggelassen.',
  OTHER_PLACES_one:
    '{{count}} Zeile oder Spalte ist ein anderer Ort eines Kunden, {{cell}}: Alles andere gilt wie am eigenen.',
  OTHER_PLACES_other:
    '{{count}} Zeilen oder Spalten sind andere Orte von Kunden, wie {{cell}}: Alles andere gilt wie am eigenen.',
  PAST_MIDNIGHT_one: '{{count}} Fenster endet am Tag danach: {{cell}}.',
  PAST_MIDNIGHT_other: '{{count}} Fenster enden am Tag danach, wie {{cell}}.',
  PLACED_BY_HAND_one:
    '{{count}} Zeile hat eine Adresse ohne Koordinaten, {{cell}}: Setzen Sie sie von Hand auf die Karte.',
  PLACED_BY_HAND_other:
    '{{count}} Zeilen haben eine Adresse ohne Koordinaten, wie {{cell}}: Setzen Sie sie von Hand auf die Karte.',
  PLANE_km: 'x und y gelten als Orte auf einer Ebene, in Kilometern.',
  PLANE_m: 'x und y gelten als Orte auf einer Ebene, in Metern.',
  PREFERENCE_ASSUMED_one:
    '{{count}} Kunde bevorzugt ein Fahrzeug und sagt nicht, wie sehr, {{cell}}: Jedes andere kostet {{amount}} mehr.',
  PREFERENCE_ASSUMED_other:
    '{{count}} Kunden bevorzugen ein Fahrzeug und sagen nicht, wie sehr, wie {{cell}}: Jedes andere kostet {{amount}} mehr.',
  PREFERENCE_UNKNOWN_one:
    '{{count}} bevorzugtes Fahrzeug oder bevorzugten Fahrer hat die Flotte nicht, „{{name}}“ ({{cell}}): Daraus folgt nichts.',
  PREFERENCE_UNKNOWN_other:
    '{{count}} bevorzugte Fahrzeuge oder Fahrer hat die Flotte nicht, wie „{{name}}“ ({{cell}}): Daraus folgt nichts.',
  READY_IS_BEGIN:
    'Spalte {{column}} gilt als Beginn der Fenster: Sie kann auch heißen, wann Pakete da sind.',
  RELATED_TO_NOBODY:
    '„{{name}}“ ({{cell}}) ist weder ein anderer Kunde noch in einer anderen Zeile und bindet niemanden.',
  RESTS_ASSUMED: 'Ruhezeiten ohne Dauer: Sie dauern {{minutes}} min.',
  RESTS_UNUSED: 'Ruhezeiten sind ohne Lenkregeln angegeben: Daraus folgt nichts.',
  RIDES_BACK_one:
    '{{count}} Zeile nennt eine Rückfahrt, {{cell}}: Sie ist eine eigene Sendung zurück.',
  RIDES_BACK_other:
    '{{count}} Zeilen nennen eine Rückfahrt, wie {{cell}}: Jede ist eine eigene Sendung zurück.',
  RIDE_UNUSED_one:
    '{{count}} Zeile nennt eine Fahrt, {{cell}}, aber nur einen Ort: Daraus folgt nichts.',
  RIDE_UNUSED_other:
    '{{count}} Zeilen nennen eine Fahrt, wie {{cell}}, aber nur einen Ort: Daraus folgt nichts.',
  ROWS_JOINED_one:
    '{{count}} Stopp ist aus Zeilen mit gleichem Namen und Ort, {{name}} ({{cells}}): Mengen zählen zusammen, die längste Dauer einmal.',
  ROWS_JOINED_other:
    '{{count}} Stopps sind aus Zeilen mit gleichem Namen und Ort, wie {{name}} ({{cells}}): Mengen zählen zusammen, die längste Dauer einmal.',
  ROWS_LEFT_OUT: 'Zeilen mit Fehlern sind weggelassen.',
  RULES_IN_FILE: 'Das Blatt {{sheet}} wird als Regeln für den ganzen Plan gelesen.',
  RULES_UNUSED: 'Vom Blatt {{sheet}} wird nicht verwendet: {{names}}.',
  SEVERAL_DAYS: 'Es sind {{count}} Tage: Sagen Sie, welcher geplant wird.',
  SHIFT: 'Die Arbeitszeit „{{value}}“ ist nicht zu lesen: Schreiben Sie sie wie 8:00-17:00.',
  SHIFT_ASSUMED: 'Keine Arbeitszeit angegeben: Fahrzeuge fahren jederzeit.',
  SHIFT_ENDS_BEFORE_START:
    'Eine Schicht endet, bevor sie beginnt: Schreiben Sie {{end}}, wenn der Tag danach gemeint ist.',
  SHIFT_OVERNIGHT: 'Eine Schicht endet am Tag danach, um {{end}}.',
  SHIPMENT_AMOUNTS:
    '{{name}}: Geholt wird eine andere Menge als gebracht: Geben Sie dieselbe an, oder nur eine.',
  SHIPMENT_AMOUNTS_lacks: '{{name}}: Geben Sie die Menge jeder Abholung an.',
  SHIPMENT_IN_ORDER_one:
    '{{count}} Sendung sagt nicht, welche Zeile die Abholung ist, {{cell}}: Es ist die erste.',
  SHIPMENT_IN_ORDER_other:
    '{{count}} Sendungen sagen nicht, welche Zeile die Abholung ist, wie {{cell}}: Es ist die erste.',
  SHIPMENT_OF_ONE_ROW_one:
    '{{count}} Sendung hat eine Zeile und einen Ort, {{cell}}: Sie ist ein Kunde.',
  SHIPMENT_OF_ONE_ROW_other:
    '{{count}} Sendungen haben eine Zeile und einen Ort, wie {{cell}}: Sie sind Kunden.',
  SHIPMENT_ROWS:
    '{{name}}: Sagen Sie von jeder Zeile der Sendung, ob sie Abholung oder Zustellung ist.',
  SHIPMENT_ROWS_places: '{{name}}: Die Sendung hat zu viele Orte: Machen Sie mehrere daraus.',
  SKILLS_ASSUMED: 'Alle Fahrzeuge haben die Fähigkeiten, die Kunden brauchen: {{names}}.',
  SWAPPED: 'Breite und Länge sind vertauscht und werden getauscht.',
  TOO_MANY_CELLS:
    'Die Zeile hat mehr Zellen als es Überschriften gibt: Speichern Sie mit Semikolons oder als Arbeitsmappe.',
  TOO_MANY_WINDOWS: 'Es sind {{count}} Fenster; möglich sind höchstens {{most}}.',
  TOTAL_LEFT_OUT: 'Eine Summe ist weggelassen ({{cell}}).',
  TRIPS_ASSUMED: 'Fahrzeuge fahren bis zu {{count}}-mal hinaus.',
  UNIT_GUESSED: 'Bei Spalte {{column}} ist die Einheit geraten: {{unit}}.',
  WHICH_END: 'Spalte {{column}} kann von der Abholung oder der Lieferung sein.',
  WRONG_LENGTH:
    'Es sind {{count}} Stopps; höchstens {{most}} werden auf einmal geplant: Teilen Sie die Datei.',
  ZONE_NOT_READ:
    'Zeiten wie {{cell}} ({{value}}) gelten, wie sie dastehen: Ihre Zeitzone bleibt außer Acht.',
};
