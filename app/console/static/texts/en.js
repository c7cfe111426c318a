/** The console's texts in English, by view. A text in several numbers ends in `_one`, `_other`. */

export default {
  app: {
    loading: 'Loading the console.',
    starting: 'The service is starting.',
    progress: 'How far it is',
    close: 'Close',
    more: 'and {{count}} more',
  },
  header: {
    language: 'Language',
  },
};
