/** What this browser keeps: records by keys that are lists, in one database. */

import { createStore } from '../../vendor/idb-keyval-6.3.0/index.js';
import { t } from '../texts.js';

const DATABASE = 'tandem';

/** The browser keeps nothing, or no more. */
export class StorageError extends Error {
  constructor(cause) {
    const isFull = cause?.name === 'QuotaExceededError';
    super(isFull ? t('kept.full') : t('kept.private'), { cause });
    Object.assign(this, { isFull, title: t('kept.unkept') });
  }
}

let open = null;

const failures = new WeakMap(); // of transactions that we ended ourselves

/**
 * Do what belongs together: all of it is written, or nothing.
 *
 * @param mode `readonly` or `readwrite`
 * @param work gets the records and a function that sets what is returned in the end
 */
export async function transact(mode, work) {
  try {
    open ??= createStore(DATABASE, 'records');
    return await open(
      mode,
      (records) =>
        new Promise((resolve, reject) => {
          let result;
          const { transaction } = records;
          transaction.oncomplete = () => resolve(result);
          transaction.onabort = () => reject(failures.get(transaction) ?? transaction.error);
          work(records, (value) => {
            result = value;
          });
        }));
  } catch (error) {
    throw new StorageError(error);
  }
}

/** Call `then` with the value of a request, within its transaction, which ends where that fails. */
export function whenRead(request, then) {
  request.onsuccess = () => {
    try {
      then(request.result);
    } catch (error) {
      failures.set(request.transaction, error);
      request.transaction.abort();
    }
  };
}

/** Return the range of all keys that begin with a list. */
export function below(...beginning) {
  return IDBKeyRange.bound(beginning, [...beginning, []]);
}

/** Return all values whose keys begin with a list. */
export function readAll(...beginning) {
  return transact('readonly', (records, give) => {
    whenRead(records.getAll(below(...beginning)), give);
  });
}

/** Return a name that nothing else has. */
export function newId() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}
