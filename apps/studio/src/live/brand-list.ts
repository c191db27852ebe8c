import { BRANDS, robotsOf, type Datum } from "@twincell/controllers";
import { LIBRARY, type Robot } from "@twincell/core";
import { PLUG_IN, PLUG_IN_PORT } from "@twincell/messages";
import { words } from "../words/index.ts";

export interface OfferedBrand {
  readonly id: string;
  readonly name: string;
  /** Of the library, that it drives. */
  readonly robots: readonly Robot[];
  readonly data: readonly Datum[];
  /** A port that is asked for, where there is no vendor who fixed it. */
  readonly port: number | null;
}

/** What the dialog offers: brands with a virtual controller in the page, and drivers that are processes of their own (row T-60). */
export const BRAND_LIST: readonly OfferedBrand[] = [
  ...BRANDS.map(brand => ({
    id: brand.id,
    name: brand.name,
    robots: robotsOf(brand),
    data: brand.data ?? [],
    port: null,
  })),
  { id: PLUG_IN, name: words.stations.plugInBrand, robots: LIBRARY, data: [], port: PLUG_IN_PORT },
];
