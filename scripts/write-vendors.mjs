/**
 * Writes docs/vendors.md from what the dialects declare: node scripts/write-vendors.mjs. A test holds the file to it.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { DIALECTS, vendorTables } from "@twincell/languages";

const file = new URL("../docs/vendors.md", import.meta.url);
const text = readFileSync(file, "utf8");
const [before, , after] = text.split(/(?<=<!-- tables -->\n)([^]*)(?=<!-- end of tables -->)/);
writeFileSync(file, `${before}\n${vendorTables(DIALECTS)}\n\n${after}`);
