// How far the drawn links are from the published meshes that lie beside the checkout: node scripts/measure-shapes.ts
// [ROBOT …]
import { shapeDeviation, LIBRARY, linkDesigns, seededRandom } from "@twincell/core";
import { vendorLinks } from "./shapes/vendor.ts";

const SAMPLES = 20_000;
const mm = (length_m: number): string => (1000 * length_m).toFixed(1).padStart(7);
const asked = process.argv.slice(2);
process.stdout.write("robot                       link   true outside drawn   solid outside true [mm]\n");
for (const robot of LIBRARY.filter(({ id }) => asked.length === 0 || asked.includes(id))) {
  const links = vendorLinks(robot.id);
  if (links === null) {
    process.stdout.write(`${robot.id.padEnd(28)}no meshes at hand\n`);
    continue;
  }
  let worst = 0;
  linkDesigns(robot).forEach(({ parts, shells }, link) => {
    const out = shapeDeviation(
      parts.map(({ mesh }) => mesh),
      links[link]!,
      SAMPLES,
      seededRandom(link),
    ).trueOutsideDrawn_m;
    const over = shapeDeviation(shells, links[link]!, SAMPLES, seededRandom(link)).drawnOutsideTrue_m;
    worst = Math.max(worst, out, over);
    process.stdout.write(`${robot.id.padEnd(28)}${String(link).padStart(4)}   ${mm(out)}              ${mm(over)}\n`);
  });
  process.stdout.write(`${robot.id.padEnd(28)} all   ${mm(worst)}   stored ${mm(robot.shapeError_m)}\n`);
}
