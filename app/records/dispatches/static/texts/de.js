/** Die Texte der Fahrerseite auf Deutsch; Wortliste siehe die der Konsole. */

import reason from '../../console/texts/reasons/de.js';

export default {
  page: {
    title: 'Stopps von heute',
    opening: 'Ihr Tag wird geöffnet.',
    language: 'Sprache',
    navigate: 'Navigieren mit',
    phone: 'Karten dieses Telefons',
  },
  failure: {
    unreached:
      'Ihr Tag ist noch nicht auf diesem Telefon, und der Dienst ist nicht erreichbar.',
    noLink: 'Öffnen Sie den Link, den Sie bekommen haben.',
    unknown:
      'Öffnen Sie den Link, den Sie bekommen haben, noch einmal ganz, oder bitten Sie um ' +
      'einen neuen.',
    over: 'Der Link wurde widerrufen oder sein Tag ist vorbei: Bitten Sie um einen neuen.',
    refused:
      'Ihre Meldung wurde abgelehnt (der Dienst antwortet {{status}}): Rufen Sie die ' +
      'Disposition an.',
  },
  day: {
    over: '{{count}} von {{of}} erledigt',
    flies: '{{vehicle}} (fliegt)',
    unsent: '{{count}} noch nicht gesendet: wird gesendet, sobald Netz da ist.',
    sent: 'Alles ist gesendet.',
    offline: 'Kein Netz: Was Sie melden, bleibt auf diesem Telefon.',
    changed: 'Ihr Tag wurde geändert: Sehen Sie nach, was als Nächstes kommt.',
    seen: 'Gesehen',
    added: 'Neu',
    gone: 'Entfällt',
    nothing: 'Für Sie ist nichts mehr geplant.',
  },
  flights: {
    format: 'Flüge als',
    save: 'Flüge sichern',
    facts: 'Angaben für eine Flugsteuerung, keine Erlaubnis zu fliegen.',
    offline: 'Der Dienst ist nicht erreichbar: Versuchen Sie es noch einmal.',
    refused: 'Diese Flüge lassen sich in diesem Format nicht angeben: Wählen Sie ein anderes.',
  },
  share: {
    switch: 'Zeigen, wo ich bin',
    who:
      'Nur die Disposition sieht es, nur heute, höchstens zweimal in der Minute, solange diese ' +
      'Seite offen ist.',
    refused: 'Dieses Telefon sagt nicht, wo es ist: Erlauben Sie es dieser Seite.',
  },
  breakdown: {
    told: 'Sie haben eine Panne gemeldet: Andere werden für Ihre Stopps eingeplant.',
    over: 'Es geht wieder weiter',
    begin: 'Mein Fahrzeug hat eine Panne',
    sure: 'Kann Ihr Fahrzeug heute niemanden mehr beliefern?',
    yes: 'Panne melden',
    back: 'Zurück',
  },
  proof: {
    begin: 'Zustellnachweis',
    kept: 'Ein Nachweis ist da.',
    name: 'Name des Empfängers',
    photo: 'Foto',
    signature: 'Unterschrift',
    keep: 'Nachweis behalten',
  },
  title: {
    depart: 'Abfahrt {{place}}',
    launch: '{{drone}} starten zu {{names}}',
    recover: '{{drone}} aufnehmen',
    return: 'Zurück bei {{place}}',
    there: '{{title}}, bei {{place}}',
  },
  state: {
    done: 'erledigt',
    failed: 'gescheitert',
    unsent: '(wartet)',
  },
  fact: {
    planned: 'Geplant',
    window: 'Zeitfenster',
    at: 'Bei',
    load: 'Ladung',
    for: 'Für',
    handOver: 'Abgeben',
    takeIn: 'Mitnehmen',
    address: 'Adresse',
    notes: 'Hinweise',
    order: 'Auftrag',
    name: 'Name',
    phone: 'Telefon',
  },
  time: {
    span: '{{from}} bis {{until}}',
    from: 'ab {{from}}',
    until: 'bis {{until}}',
  },
  action: {
    call: '{{number}} anrufen',
    navigate: 'Navigieren',
    undo: 'Zurücknehmen',
    failed: 'Gescheitert',
    why: 'Warum?',
    tap: 'Ein Tippen meldet es.',
    words: 'In Ihren Worten',
    tell: 'So melden',
    back: 'Zurück',
  },
  done: {
    depart: 'Abgefahren',
    stop: 'Erledigt',
    launch: 'Gestartet',
    recover: 'Aufgenommen',
    return: 'Ich bin zurück',
  },
  reason,
};
