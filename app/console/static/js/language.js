/** Texts in the language of whoever reads them; the console and drivers' page share this. */

import { createInstance } from '../vendor/i18next-26.7.2/i18next.js';

/** Languages that there are texts in, as their speakers call them. */
export const LANGUAGES = { en: 'English', de: 'Deutsch' };

const KEPT = 'tandem-language';
const FALLBACK = 'en';
const MARK = '\u0000'; // stands around what is no text
const DIGITS = 2;

/** Return the language that was chosen here, else the first of the browser's that is known. */
export function wanted() {
  if (typeof document === 'undefined') return FALLBACK;
  const kept = localStorage.getItem(KEPT);
  const stated = navigator.languages.map((tag) => tag.toLowerCase().split('-')[0]);
  return [kept, ...stated].find((name) => name in LANGUAGES) ?? FALLBACK;
}

/** What the library asks for every value in a text: numbers are written as the language does. */
const NUMBERS = {
  type: 'formatter',
  format(value, _, name) {
    if (typeof value !== 'number') return value;
    return value.toLocaleString(name, { maximumFractionDigits: DIGITS }).replace('-', '\u2212');
  },
};

/**
 * Return what says texts: `{t, parts, language, choose}`.
 *
 * @param texts by language: `{en: {view: {key: text}}, de: ...}`; the wanted one is among them
 * @param load returns a promise of those of another language
 */
export function speaking(texts, load = null) {
  const library = createInstance().use(NUMBERS);
  library.init({
    resources: Object.fromEntries(
      Object.entries(texts).map(([name, translation]) => [name, { translation }])),
    initAsync: false,
    lng: FALLBACK,
    fallbackLng: FALLBACK,
    nsSeparator: false,
    interpolation: { escapeValue: false, alwaysFormat: true },
  });
  const said = Object.fromEntries(
    Object.keys(texts).map((name) => [name, library.getFixedT(name)]));
  let language;

  function speak(name) {
    language = name;
    if (typeof document !== 'undefined') document.documentElement.lang = name;
  }

  speak(wanted());

  /** Return a text; `values` stand for its `{{names}}`, and `count` chooses its number. */
  const t = (key, values) => said[language](key, values);

  return {
    t,
    /** Return a text as an array, with elements of a page where `values` holds some. */
    parts(key, values) {
      const nodes = Object.values(values);
      const marks = Object.keys(values).map((name, at) => [
        name,
        typeof values[name] === 'object' ? `${MARK}${at}${MARK}` : values[name]]);
      const text = t(key, Object.fromEntries(marks));
      return text
        .split(MARK)
        .map((part, at) => (at % 2 ? nodes[part] : part))
        .filter((part) => part !== '');
    },
    /** Return the language that is spoken, as numbers and dates take it. */
    language: () => language,
    /** Speak another language once its texts are there, and after the page was closed. */
    async choose(name) {
      if (!said[name]) {
        library.addResourceBundle(name, 'translation', await load(name));
        said[name] = library.getFixedT(name);
      }
      localStorage.setItem(KEPT, name);
      speak(name);
    },
  };
}
