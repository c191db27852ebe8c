import { noLineFaults, type LineFaults } from "../../transport/index.ts";

/** What the controller and its line do wrong, by switch, on any network. All at rest by default. */
export interface KukaFaults extends LineFaults {
  /** Of RSI telegrams to the sensor, lost and sent twice. */
  loss: number;
  duplicates: number;
}
export const noFaults = (): KukaFaults => ({ ...noLineFaults(), loss: 0, duplicates: 0 });
