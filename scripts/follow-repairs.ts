// node scripts/follow-repairs.ts [TRIES] [SEED]: how many programs whose points were moved away at random become good
// by nothing but the "repair" fields of their verdicts. The last result is kept in docs/mcp.md.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { addCatalogue } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { tracedCartonCell } from "@twincell/project";
import { CellFolder } from "../apps/cli/src/mcp/cell-folder.ts";
import { followRepairs } from "../apps/cli/src/mcp/testing/follow-repairs.ts";

const [tries = "100", seed = "95"] = process.argv.slice(2);
addCatalogue(CATALOGUE);
const folder = mkdtempSync(join(tmpdir(), "twincell-repairs-"));
try {
  const { bad, mended } = await followRepairs(
    await CellFolder.open(folder),
    tracedCartonCell(),
    Number(tries),
    Number(seed),
  );
  console.log(`${mended} of ${bad} bad programs mended (${tries} tries, seed ${seed})`);
} finally {
  rmSync(folder, { recursive: true, force: true });
}
