/* Keeps drivers' page on the phone, so that it opens without network. VERSION stands before. */

const CACHE = `drive-${VERSION}`;
const FILES = [
  './',
  'drive.css',
  'icon.svg',
  'manifest.webmanifest',
  'js/clocks.js',
  'js/days.js',
  'js/flights.js',
  'js/language-choice.js',
  'js/link.js',
  'js/main.js',
  'js/navigators.js',
  'js/positions.js',
  'js/proofs.js',
  'js/queue.js',
  'js/reasons.js',
  'js/steps.js',
  'js/texts.js',
  'js/views.js',
  'texts/de.js',
  'texts/en.js',
  '../console/js/language.js',
  '../console/texts/reasons/de.js',
  '../console/texts/reasons/en.js',
  '../console/vendor/htm-3.1.1/standalone.module.js',
  '../console/vendor/i18next-26.7.2/i18next.js',
];

self.addEventListener('install', (event) => {
  const keep = async () => {
    const cache = await caches.open(CACHE);
    await cache.addAll(FILES.map((file) => new Request(file, { cache: 'no-cache' })));
    await self.skipWaiting();
  };
  event.waitUntil(keep());
});

self.addEventListener('activate', (event) => {
  const clean = async () => {
    const names = await caches.keys();
    const former = names.filter((name) => name.startsWith('drive-') && name !== CACHE);
    await Promise.all(former.map((name) => caches.delete(name)));
    await self.clients.claim();
  };
  event.waitUntil(clean());
});

// What is told and asked goes its own way, past here.
self.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || /\/drive\/(day|events|flights)(\?|$)/.test(request.url)) return;
  const answer = async () => {
    const cache = await caches.open(CACHE);
    return (await cache.match(request, { ignoreSearch: true })) ?? fetch(request);
  };
  event.respondWith(answer());
});
