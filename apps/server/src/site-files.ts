import { staticFiles } from "./static-files.ts";

const DOCS = "/docs";

/**
 * The built studio, and under /docs/ the built documentation where there is one.
 *
 * @param studio  folder of the studio. @param docs  folder of the documentation; left out: /docs/ has nothing.
 */
export function siteFiles(studio: string, docs: string | undefined): ReturnType<typeof staticFiles> {
  const ofStudio = staticFiles(studio);
  if (docs === undefined) return ofStudio;
  const ofDocs = staticFiles(docs);
  return (path, accepts, knownEtag) =>
    path === DOCS || path.startsWith(`${DOCS}/`)
      ? ofDocs(path.slice(DOCS.length) || "/", accepts, knownEtag)
      : ofStudio(path, accepts, knownEtag);
}
