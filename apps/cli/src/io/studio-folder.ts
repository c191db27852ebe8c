import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

/**
 * The documentation: beside the command line in an installed package, in its own folder in the source tree, where it
 * may still have to be built.
 */
export function docsFolder(): string {
  const packaged = fileURLToPath(new URL("../docs", import.meta.url));
  return ["index.html", "index.html.br"].some(file => existsSync(`${packaged}/${file}`))
    ? packaged
    : fileURLToPath(new URL("../../../../docs/.vitepress/dist", import.meta.url));
}

/** The built studio: beside the command line in an installed package, in its own folder in the source tree. */
export function studioFolder(): string {
  const packaged = fileURLToPath(new URL("../studio", import.meta.url));
  return existsSync(`${packaged}/index.html`)
    ? packaged
    : fileURLToPath(new URL("../../../studio/dist", import.meta.url));
}
