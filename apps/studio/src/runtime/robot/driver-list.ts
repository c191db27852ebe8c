import { DRIVER_KINDS, robotsOf, type ConnectionParameter } from "@twincell/controllers";
import { LIBRARY, type Robot } from "@twincell/core";
import { PLUG_IN, PLUG_IN_PORT } from "@twincell/protocol";
import { words } from "../../messages/index.ts";

export interface OfferedDriver {
  readonly id: string;
  readonly name: string;
  /** Of the library and the catalogue, that it drives. */
  readonly robots: readonly Robot[];
  readonly data: readonly ConnectionParameter[];
  /** A port that is asked for, where there is no vendor who fixed it. */
  readonly port: number | null;
}

/**
 * What the dialog offers: brands with a virtual controller in the page, and drivers that are processes of their own
 * (row T-60).
 */
export const DRIVER_LIST: readonly OfferedDriver[] = [
  ...DRIVER_KINDS.map(kind => ({
    id: kind.id,
    name: kind.name,
    // Asked for when it is shown: the catalogue comes after the start.
    get robots() {
      return robotsOf(kind);
    },
    data: kind.data ?? [],
    port: null,
  })),
  { id: PLUG_IN, name: words.stations.plugInBrand, robots: LIBRARY, data: [], port: PLUG_IN_PORT },
];
