import type { Dialect } from "@twincell/core";
import { vPlus } from "./v-plus/index.ts";

export { vPlus } from "./v-plus/index.ts";
export * from "./prove.ts";

/** Every dialect. A new one is a folder and one line here. */
export const DIALECTS: readonly Dialect[] = [vPlus];

/** The dialect of that id, or undefined. */
export const dialectById = (id: string): Dialect | undefined => DIALECTS.find(dialect => dialect.id === id);
export { vendorTables } from "./vendors.ts";
