/* Sets light or dark before anything is drawn; a script of its own so that nothing blinks. */
(function setTheme() {
  const chosen = localStorage.getItem('tandem-theme');
  const dark = chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  const developer = localStorage.getItem('tandem-developer') === 'on';
  document.documentElement.toggleAttribute('data-developer', developer);
})();
