import { staticFiles, type StaticAnswer } from "./static-files.ts";

const DOCS = "/docs";
const NOT_BUILT: StaticAnswer = {
  status: 404,
  headers: { "content-type": "text/plain; charset=utf-8", "cache-control": "no-store" },
  body: Buffer.from(
    "The documentation is not built yet. npm start builds it beside the studio: open this page again in a minute. " +
      "npm run docs builds it at once.\n",
  ),
};

/**
 * The built studio, and under /docs/ the built documentation where there is one.
 *
 * @param studio  folder of the studio.
 * @param docs    folder of the documentation, which may come later; left out: /docs/ has nothing.
 */
export function siteFiles(studio: string, docs: string | undefined): ReturnType<typeof staticFiles> {
  const ofStudio = staticFiles(studio);
  if (docs === undefined) return ofStudio;
  const ofDocs = staticFiles(docs);
  return async (path, accepts, knownEtag) => {
    if (path !== DOCS && !path.startsWith(`${DOCS}/`)) return ofStudio(path, accepts, knownEtag);
    const answer = await ofDocs(path.slice(DOCS.length) || "/", accepts, knownEtag);
    if (answer.status !== 404) return answer;
    const start = await ofDocs("/", accepts, undefined);
    return start.status === 404 ? NOT_BUILT : answer;
  };
}
