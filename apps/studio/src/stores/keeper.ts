/** A place that keeps texts: the browser's database, or a double in tests. Writing may fail. */
export interface Keeper {
  get(key: string): Promise<unknown>;
  set(key: string, value: unknown): Promise<void>;
}
