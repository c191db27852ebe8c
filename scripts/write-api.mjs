/** Writes docs/public-api from the sources: node scripts/write-api.mjs. A test holds the files to them. */
import { mkdirSync, writeFileSync } from "node:fs";
import { publicApiReports, reportFolder } from "./api/report.mjs";

mkdirSync(reportFolder, { recursive: true });
for (const [file, text] of publicApiReports()) writeFileSync(new URL(file, reportFolder), text);
