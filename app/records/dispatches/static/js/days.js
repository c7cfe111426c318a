/** What the phone keeps: days, and what was told of them and isn't sent yet. */

const NAME = 'tandem-drive';

let opening = null;

function database() {
  opening ??= new Promise((resolve, reject) => {
    const request = indexedDB.open(NAME, 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore('days', { keyPath: 'link' });
      const events = request.result.createObjectStore('events', {
        keyPath: 'number',
        autoIncrement: true,
      });
      events.createIndex('link', 'link');
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
  return opening;
}

/** Do something with a store and return what came of it, once it is on the disk. */
async function run(store, mode, work) {
  const opened = await database();
  return new Promise((resolve, reject) => {
    const transaction = opened.transaction(store, mode, { durability: 'strict' });
    const request = work(transaction.objectStore(store));
    transaction.oncomplete = () => resolve(request?.result);
    transaction.onabort = () => reject(transaction.error);
  });
}

/** Return the day of a link, or undefined. */
export function keptDay(link) {
  return run('days', 'readonly', (store) => store.get(link));
}

/** Keep a day. */
export function keepDay(day) {
  return run('days', 'readwrite', (store) => store.put(day));
}

/** Forget a day. */
export function forgetDay(link) {
  return run('days', 'readwrite', (store) => store.delete(link));
}

/** Keep what was told until it is sent. */
export function keepEvent(event) {
  return run('events', 'readwrite', (store) => store.add(event));
}

/** Return what was told by a link and isn't sent yet, in order. */
export function waitingEvents(link) {
  return run('events', 'readonly', (store) => store.index('link').getAll(link));
}

/** Forget what was sent. */
export function dropEvents(events) {
  return run('events', 'readwrite', (store) => {
    events.forEach(({ number }) => store.delete(number));
  });
}
