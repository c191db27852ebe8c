/** What the history feature asks of whoever looks back at recordings. */
export interface Travel {
  open(id: string): Promise<void>;
  seek(to_s: number): void;
  setSpeed(factor: number): void;
  bytes(id: string): Promise<Uint8Array<ArrayBuffer>>;
  remove(id: string): Promise<void>;
}
let travel: Travel | null = null;
export const offerTravel = (offered: Travel): void => { travel = offered; };
export const theTravel = (): Travel | null => travel;
