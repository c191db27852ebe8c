/** A place that keeps texts: the browser's database, or a double in tests. Writing may fail. */
export interface Keeper {
  get(key: string): Promise<unknown>;
  set(key: string, value: unknown): Promise<void>;
}

/** A place that keeps texts by key, lists its keys and can delete. Every call may fail; one `set` is all or nothing. */
export interface KeyValueStore extends Keeper {
  keys(): Promise<readonly unknown[]>;
  delete(key: string): Promise<void>;
}
