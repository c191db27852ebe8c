import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

/** The built studio: beside the command line in an installed package, in its own folder in the source tree. */
export function studioFolder(): string {
  const packaged = fileURLToPath(new URL("../studio", import.meta.url));
  return existsSync(`${packaged}/index.html`)
    ? packaged
    : fileURLToPath(new URL("../../../studio/dist", import.meta.url));
}
