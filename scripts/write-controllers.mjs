/**
 * Writes docs/controllers/README.md from what the drivers declare: node scripts/write-controllers.mjs. A test holds the
 * file to it.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { driverTables, DRIVERS } from "@twincell/controllers";

const file = new URL("../docs/controllers/README.md", import.meta.url);
const text = readFileSync(file, "utf8");
const [before, , after] = text.split(/(?<=<!-- tables -->\n)([^]*)(?=<!-- end of tables -->)/);
writeFileSync(file, `${before}\n${driverTables(DRIVERS)}\n\n${after}`);
