/** Warum Schritte der Fahrer scheitern, wie Disponenten und Fahrer es lesen. */

export default {
  nobody: 'Niemand da',
  refused: 'Annahme verweigert',
  address: 'Falsche Adresse',
  damaged: 'Beschädigt',
  time: 'Keine Zeit mehr',
  wind: 'Zu viel Wind',
  broken: 'Drohne ist defekt',
  battery: 'Akku ist leer',
  parcel: 'Kam mit dem Paket zurück',
  lost: 'Kam nicht zurück',
  breakdown: 'Panne',
};
