/** The texts of customers' page in English. */

export default {
  visit: {
    title: 'Your delivery',
    order: 'Order {{order}}',
    coming: 'Between {{from}} and {{to}}',
    arriving: 'Expected at {{arrival}}',
    truck: '{{vehicle}} brings it.',
    drone: 'A drone of {{vehicle}} brings it.',
    served: 'It has been delivered.',
    failed: 'It could not be delivered.',
    open: 'It is being planned.',
    changes: 'What changed',
    changed: 'Told at {{at}}: {{arrival}}',
    current: 'Up to date at {{at}}',
    language: 'Language',
  },
  failure: {
    over: 'This link is no longer valid: the day is over, or the order was cancelled.',
    wrong: 'This link is not valid. Open the one that you were sent as a whole.',
    unreached: 'No connection. It is tried again.',
  },
};
