/** What costs are in where nobody says so: the currency of where the browser is. */

const BY_ZONE = {
  'Europe/London': 'GBP', 'Europe/Zurich': 'CHF', 'Europe/Vaduz': 'CHF', 'Europe/Warsaw': 'PLN',
  'Europe/Prague': 'CZK', 'Europe/Budapest': 'HUF', 'Europe/Bucharest': 'RON',
  'Europe/Stockholm': 'SEK', 'Europe/Oslo': 'NOK', 'Europe/Copenhagen': 'DKK',
  'Europe/Istanbul': 'TRY', 'Asia/Tokyo': 'JPY', 'Asia/Shanghai': 'CNY', 'Asia/Kolkata': 'INR',
  'Asia/Calcutta': 'INR', 'America/Sao_Paulo': 'BRL', 'America/Mexico_City': 'MXN',
  'America/Toronto': 'CAD', 'America/Vancouver': 'CAD', 'Pacific/Auckland': 'NZD',
};

const EURO_CITIES = [
  'Amsterdam Andorra Athens Berlin Bratislava Brussels Busingen Dublin Helsinki Lisbon Ljubljana',
  'Luxembourg Madrid Malta Monaco Paris Podgorica Riga Rome San_Marino Sofia Tallinn Vatican',
  'Vienna Vilnius Zagreb',
].flatMap((line) => line.split(' '));

const BY_REGION = { US: 'USD', GB: 'GBP', CA: 'CAD', AU: 'AUD', CH: 'CHF', PL: 'PLN', JP: 'JPY' };
const EURO_REGIONS = 'AT BE BG CY DE EE ES FI FR GR HR IE IT LT LU LV MT NL PT SI SK'.split(' ');

/**
 * Return a currency's code, undefined where none is clear.
 *
 * @param zone of the browser's clock, which tells more of where it is than its language does
 * @param language as the browser names it, such as `de-CH`
 */
export function currencyOf(zone, language) {
  const [continent, city] = zone.split('/');
  if (continent === 'Europe' && EURO_CITIES.includes(city)) return 'EUR';
  if (BY_ZONE[zone]) return BY_ZONE[zone];
  if (continent === 'Australia') return 'AUD';
  const { region } = new Intl.Locale(language);
  if (continent === 'America' && region === 'US') return 'USD';
  if (city) return undefined;
  return EURO_REGIONS.includes(region) ? 'EUR' : BY_REGION[region];
}
