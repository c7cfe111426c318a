/** The texts of customers' page in German. */

export default {
  visit: {
    title: 'Ihre Lieferung',
    order: 'Auftrag {{order}}',
    coming: 'Zwischen {{from}} und {{to}}',
    arriving: 'Erwartet um {{arrival}}',
    truck: '{{vehicle}} bringt sie.',
    drone: 'Eine Drohne von {{vehicle}} bringt sie.',
    served: 'Sie wurde zugestellt.',
    failed: 'Sie konnte nicht zugestellt werden.',
    open: 'Sie wird noch geplant.',
    changes: 'Was sich geändert hat',
    changed: 'Gemeldet um {{at}}: {{arrival}}',
    current: 'Stand {{at}}',
    language: 'Sprache',
  },
  failure: {
    over: 'Dieser Link gilt nicht mehr: Der Tag ist vorbei, oder der Auftrag wurde storniert.',
    wrong: 'Dieser Link ist nicht gültig. Öffnen Sie ihn ganz, so wie er Ihnen geschickt wurde.',
    unreached: 'Keine Verbindung. Es wird weiter versucht.',
  },
};
