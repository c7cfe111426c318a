/** What an import takes for granted, or can't use, by the service's codes and values. */

export default {
  ADDRESSES_PENDING:
    '{{known}} of {{asked}} addresses are looked up so far: open the file again to go on.',
  ADDRESS_AMBIGUOUS: '“{{address}}” may be several places: add the town or the postcode.',
  ADDRESS_FAR: '“{{address}}” is far from all others: {{place}}.',
  ADDRESS_INEXACT: '“{{address}}” is found only roughly: {{place}}.',
  ADDRESS_NEAREST:
    '“{{address}}” may be several places; the one nearest to the others is taken: {{place}}.',
  ADDRESS_NOT_FOUND: '“{{address}}” is not found: correct it, or state latitude and longitude.',
  ALTERNATIVE: 'The other place belongs to no customer, or lacks something.',
  ANSWER: '“{{value}}” is none of the possible answers.',
  BALANCE_INCOMPLETE: '{{sheet}} lacks what is balanced, or what it costs: nothing is balanced.',
  BREAKS_ASSUMED_length:
    'Breaks without a length: a window of up to an hour is the break, in longer ones it lasts {{minutes}} min.',
  BREAKS_ASSUMED_time: 'Breaks without a time: they begin at most {{hours}} h after the departure.',
  CAPACITY:
    'The capacity has {{numbers}} numbers, and there are {{amounts}} amounts: state one for each.',
  CAPACITY_ASSUMED: 'No capacity is stated: each vehicle holds everything.',
  CREWS: 'Who asks for {{names}} is served by vehicles with that crew or more, as in {{cell}}.',
  DATES_GUESSED_month:
    '{{cell}} ({{value}}) may begin with the day or the month: the month comes first.',
  DATES_GUESSED_day:
    '{{cell}} ({{value}}) may begin with the day or the month: the day comes first.',
  DECIMALS_GUESSED_comma:
    '{{cell}} ({{value}}) may have decimals or thousands: the comma stands before decimals.',
  DECIMALS_GUESSED_point:
    '{{cell}} ({{value}}) may have decimals or thousands: the point stands before decimals.',
  DECIMAL_COMMAS:
    'Rows have more cells than headings, such as {{cell}}: commas between numbers are decimal commas.',
  DEGREES_GUESSED: 'x and y look like degrees: x is the longitude, y the latitude.',
  DEPOT: 'There is no depot that can be used: state where it is, latitude first.',
  DEPOT_lost: 'The depot “{{depot}}” is not found: correct it, or state latitude and longitude.',
  DEPOT_ASSUMED: 'No depot is stated: the middle of the customers is taken, {{place}}.',
  DEPOT_BY_HAND: 'The depot’s address is not looked up here: state where it is.',
  DEPOT_FOUND: 'The depot is found: {{place}}.',
  DEPOT_IN_FILE_one: '{{cells}} is the depot, not a customer.',
  DEPOT_IN_FILE_other: '{{cells}} are depots, not customers.',
  DIGITS_LOST_one:
    'Column {{column}}: a spreadsheet shortened {{count}} number, {{cell}} ({{value}}): its last digits are lost.',
  DIGITS_LOST_other:
    'Column {{column}}: a spreadsheet shortened {{count}} numbers, such as {{cell}} ({{value}}): their last digits are lost.',
  DRIVING_RULES: 'Driving rules of vehicles contradict each other, or lack something.',
  DRONE_CAPACITY: 'There are drones: state what one of them carries.',
  EMPTY_AMOUNT_one: 'Column {{column}}: {{count}} cell is empty, {{cell}}: it counts 0.',
  EMPTY_AMOUNT_other:
    'Column {{column}}: {{count}} cells are empty, such as {{cell}}: they count 0.',
  ENCODING_GUESSED:
    'The file doesn’t say its encoding: {{encoding}} is taken. Check that “{{example}}” is spelt right.',
  ENDS_BEFORE: 'The window ends ({{end}}) before it begins ({{begin}}).',
  FAR_OFF:
    '{{cell}} lies {{kilometres}} km from the middle of the customers: check its coordinates.',
  FLEET_ASSUMED_one: 'No number of vehicles is stated: {{count}} is assumed.',
  FLEET_ASSUMED_other: 'No number of vehicles is stated: {{count}} are assumed.',
  FLEET_IN_FILE_one: 'The sheet {{sheet}} has the vehicles: {{count}} row.',
  FLEET_IN_FILE_other: 'The sheet {{sheet}} has the vehicles: {{count}} rows.',
  FLEET_NAMED: 'The vehicles are those that orders name: {{names}}.',
  FLEET_UNUSED: 'Of the sheet {{sheet}} these columns aren’t used: {{names}}.',
  GEOCODER: 'Addresses can’t be looked up now: try again later.',
  HALF_PAIR: 'Column {{column}} is half a pair: the other lacks.',
  HOURS_ASSUMED:
    'What drivers cost isn’t stated: an hour costs {{amount}}, and whoever drives at all one more.',
  KILOMETRES_ASSUMED: 'What a kilometre costs isn’t stated: {{amount}} is assumed.',
  LAG_WITHOUT_ORDER_one:
    '{{count}} row states a time between two, {{cell}}, but not who comes before: it isn’t used.',
  LAG_WITHOUT_ORDER_other:
    '{{count}} rows state a time between two, such as {{cell}}, but not who comes before: it isn’t used.',
  MAYBE_SWAPPED: 'Swapped, the places would be in Europe: check latitude and longitude.',
  MEANING_BY_CONTENT: 'Column {{column}} is understood by its cells alone: {{meaning}}.',
  MIDNIGHT: 'Times are counted from midnight.',
  MISREAD: '“{{value}}” can’t be read as: {{meaning}}.',
  MISREAD_amount: '“{{value}}” is no amount, or in another unit than its column.',
  MISREAD_aside: '“{{value}}” can’t be read.',
  MISREAD_clock: '“{{value}}” is no time of day: write it as 8:30 ({{meaning}}).',
  MISREAD_date: '“{{value}}” is no date: write it as 2026-11-23.',
  MISREAD_degrees: '“{{value}}” is no number of degrees: write it as 48.137 ({{meaning}}).',
  MISREAD_duration: '“{{value}}” is no length of time: write it as 10 min ({{meaning}}).',
  MISREAD_number: '“{{value}}” is no number ({{meaning}}).',
  MISREAD_prices: '“{{value}}” is no vehicle with a price: write it as van-1: 5.',
  MISREAD_windows: '“{{value}}” is no window: write it as 8:00-10:00.',
  NAMES_REPEAT_one:
    '{{count}} stop has the name of another at another place or time and gets its own: {{cell}}, now “{{name}}”.',
  NAMES_REPEAT_other:
    '{{count}} stops have the name of another at another place or time and get their own, such as {{cell}}, now “{{name}}”.',
  NEXT_NIGHT_one: '{{count}} window is on the day after, as nobody works before: {{cell}}.',
  NEXT_NIGHT_other:
    '{{count}} windows are on the day after, as nobody works before, such as {{cell}}.',
  NO_AMOUNTS: 'No column has amounts: each customer counts 1.',
  NO_COORDINATES_neither: 'The row has neither coordinates nor an address.',
  NO_COORDINATES_row:
    'The row has no coordinates, and addresses aren’t looked up here: state latitude and longitude.',
  NO_COORDINATES_zero:
    '0, 0 is in the sea off Africa: state the customer’s latitude and longitude.',
  NO_COORDINATES_addresses:
    'No columns hold coordinates, and addresses aren’t looked up here: add columns with latitude and longitude.',
  NO_COORDINATES_columns:
    'No columns hold coordinates: say which are latitude and longitude, or x and y.',
  NO_CUSTOMERS: 'There is no customer in the file.',
  NO_DRONES_one: '{{count}} customer is for drones alone, and there are none.',
  NO_DRONES_other: '{{count}} customers are for drones alone, and there are none.',
  NO_HEADINGS: 'There are no headings: say what columns mean.',
  NOT_USED:
    'Column {{column}} isn’t used: its heading says {{meaning}}, its cells don’t, or another column is that.',
  NOT_USED_times:
    'Column {{column}} has times such as {{value}} and isn’t used: say what it means.',
  OFF_GLOBE: '{{latitude}} is no latitude, or {{longitude}} no longitude.',
  OTHER_DAYS_one: '{{count}} row of another day is left out.',
  OTHER_DAYS_other: '{{count}} rows of other days are left out.',
  OTHER_PLACES_one:
    '{{count}} row or column is another place of a customer, {{cell}}: all else is as of his own.',
  OTHER_PLACES_other:
    '{{count}} rows or columns are other places of customers, such as {{cell}}: all else is as of their own.',
  PAST_MIDNIGHT_one: '{{count}} window ends on the day after: {{cell}}.',
  PAST_MIDNIGHT_other: '{{count}} windows end on the day after, such as {{cell}}.',
  PLACED_BY_HAND_one:
    '{{count}} row has an address without coordinates, {{cell}}: place it on the map by hand.',
  PLACED_BY_HAND_other:
    '{{count}} rows have an address without coordinates, such as {{cell}}: place them on the map by hand.',
  PLANE_km: 'x and y are places on a plane, in kilometres.',
  PLANE_m: 'x and y are places on a plane, in metres.',
  PREFERENCE_ASSUMED_one:
    '{{count}} customer prefers a vehicle and doesn’t say how much, {{cell}}: any other costs {{amount}} more.',
  PREFERENCE_ASSUMED_other:
    '{{count}} customers prefer a vehicle and don’t say how much, such as {{cell}}: any other costs {{amount}} more.',
  PREFERENCE_UNKNOWN_one:
    '{{count}} preferred vehicle or driver isn’t in the fleet, “{{name}}” ({{cell}}): nothing is made of it.',
  PREFERENCE_UNKNOWN_other:
    '{{count}} preferred vehicles or drivers aren’t in the fleet, such as “{{name}}” ({{cell}}): nothing is made of them.',
  READY_IS_BEGIN: 'Column {{column}} is when windows begin: it may also be when parcels are there.',
  RELATED_TO_NOBODY:
    '“{{name}}” ({{cell}}) is neither another customer nor on another row, and binds nobody.',
  RESTS_ASSUMED: 'Rests without a length: they last {{minutes}} min.',
  RESTS_UNUSED: 'Rests are stated without driving rules: nothing is made of them.',
  RIDES_BACK_one: '{{count}} row states a ride back, {{cell}}: it is a shipment of its own.',
  RIDES_BACK_other:
    '{{count}} rows state a ride back, such as {{cell}}: each is a shipment of its own.',
  RIDE_UNUSED_one:
    '{{count}} row states a ride, {{cell}}, but one place alone: nothing is made of it.',
  RIDE_UNUSED_other:
    '{{count}} rows state a ride, such as {{cell}}, but one place alone: nothing is made of it.',
  ROWS_JOINED_one:
    '{{count}} stop is made of rows of one name and place, {{name}} ({{cells}}): amounts are added up, the longest time counts once.',
  ROWS_JOINED_other:
    '{{count}} stops are made of rows of one name and place, such as {{name}} ({{cells}}): amounts are added up, the longest time counts once.',
  ROWS_LEFT_OUT: 'Rows with errors are left out.',
  RULES_IN_FILE: 'The sheet {{sheet}} has rules of the whole plan.',
  RULES_UNUSED: 'Of the sheet {{sheet}} nothing is made of {{names}}.',
  SEVERAL_DAYS: 'There are {{count}} days: say which is planned.',
  SHIFT: 'The shift “{{value}}” can’t be read: write it as 8:00-17:00.',
  SHIFT_ASSUMED: 'No shift is stated: vehicles work at any time.',
  SHIFT_ENDS_BEFORE_START:
    'A shift ends before it begins: write its end as {{end}} if the day after is meant.',
  SHIFT_OVERNIGHT: 'A shift ends on the day after, at {{end}}.',
  SHIPMENT_AMOUNTS: '{{name}}: another amount is picked up than delivered: state the same, or one.',
  SHIPMENT_AMOUNTS_lacks: '{{name}}: state the amount of each pickup.',
  SHIPMENT_IN_ORDER_one:
    '{{count}} shipment doesn’t say which row is the pickup, {{cell}}: it is the first.',
  SHIPMENT_IN_ORDER_other:
    '{{count}} shipments don’t say which row is the pickup, such as {{cell}}: it is the first.',
  SHIPMENT_OF_ONE_ROW_one:
    '{{count}} shipment has one row and one place, {{cell}}: it is a customer.',
  SHIPMENT_OF_ONE_ROW_other:
    '{{count}} shipments have one row and one place, such as {{cell}}: they are customers.',
  SHIPMENT_ROWS: '{{name}}: say of each row of the shipment whether it is pickup or delivery.',
  SHIPMENT_ROWS_places: '{{name}}: the shipment has too many places: make several of it.',
  SKILLS_ASSUMED: 'All vehicles have the skills that customers need: {{names}}.',
  SWAPPED: 'Latitude and longitude are swapped, and are swapped back.',
  TOO_MANY_CELLS:
    'The row has more cells than headings: save the file with semicolons or as a workbook.',
  TOO_MANY_WINDOWS: 'There are {{count}} windows, and {{most}} are possible at most.',
  TOTAL_LEFT_OUT: 'A total is left out ({{cell}}).',
  TRIPS_ASSUMED: 'Vehicles go out up to {{count}} times.',
  UNIT_GUESSED: 'The unit of column {{column}} is guessed: {{unit}}.',
  WHICH_END: 'Column {{column}} may be of the pickup or of the delivery.',
  WRONG_LENGTH:
    'There are {{count}} stops; at most {{most}} are planned at once: cut the file in parts.',
  ZONE_NOT_READ:
    'Times such as {{cell}} ({{value}}) are taken as written: their time zone isn’t looked at.',
};
