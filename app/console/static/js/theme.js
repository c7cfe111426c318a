/* What is needed before modules run: light or dark, so that nothing blinks, and texts. */
(function begin() {
  const root = document.documentElement;
  const chosen = localStorage.getItem('tandem-theme');
  const dark = chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  root.dataset.theme = dark ? 'dark' : 'light';
  root.toggleAttribute('data-developer', localStorage.getItem('tandem-developer') === 'on');
  const tags = [localStorage.getItem('tandem-language') ?? '', ...navigator.languages, 'en'];
  const language = /\b(en|de)\b/.exec(tags.map((tag) => tag.split('-')[0].toLowerCase()).join())[1];
  for (const part of ['', 'granted/', 'reasons/']) {
    const { href } = new URL(`../texts/${part}${language}.js`, document.scripts[0].src);
    document.head.append(
      Object.assign(document.createElement('link'), { rel: 'modulepreload', href }));
  }
})();
