/** A set of listeners that may come and go while they are being called. */
export interface Listeners<T> {
  add(listen: (value: T) => void): () => void;
  call(value: T): void;
  clear(): void;
}
export function listeners<T>(): Listeners<T> {
  const all = new Set<{ readonly listen: (value: T) => void }>();
  return {
    add(listen) {
      const entry = { listen };
      all.add(entry);
      return () => {
        all.delete(entry);
      };
    },
    call(value) {
      for (const entry of all) entry.listen(value);
    },
    clear() {
      all.clear();
    },
  };
}
