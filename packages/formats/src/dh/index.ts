export { dhTableText, readDhTable, writeDhTable, type DhRead } from "./table.ts";
