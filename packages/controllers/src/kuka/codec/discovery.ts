/**
 * Finding a controller on the network: a datagram `WHEREAREYOU?` to UDP 7000, answered to where it came from, or in the
 * older way to UDP 6999, answered to port 7000 of who asked:  `KUKA|model|serial`.
 */
export const DISCOVERY_PORT = 7000;
export const OLD_DISCOVERY_PORT = 6999;
export const OLD_ANSWER_PORT = 7000;
export const WHERE_ARE_YOU = "WHEREAREYOU?";
export interface HereIAm {
  readonly model: string;
  readonly serial: string;
}
const MOST = 512;

export const hereIAmText = ({ model, serial }: HereIAm): string =>
  `KUKA|${model.replaceAll("|", " ")}|${serial.replaceAll("|", " ")}`;
/** Null when it is no answer. */
export function readHereIAm(text: string): HereIAm | null {
  const [maker, model, serial, more] = text.slice(0, MOST).split("|");
  return maker === "KUKA" && model !== undefined && serial !== undefined && more === undefined
    ? { model, serial }
    : null;
}
