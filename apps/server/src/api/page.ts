import { API_ROUTES, API_VERSION, SOCKETS, type ApiRoute } from "@twincell/protocol";

const escaped = (text: string): string => text.replace(/[<>&"]/g, char => `&#${char.charCodeAt(0)};`);

/** The API for people: its documents and every address. */
export function apiPage(version: string): string {
  const rows = (Object.values(API_ROUTES) as ApiRoute[])
    .map(
      ({ method, path, summary, lease }) =>
        `<tr><td>${method.toUpperCase()}</td><td><code>${escaped(path)}</code></td><td>${escaped(summary)}${lease === "needed" ? " · lease" : ""}</td></tr>`,
    )
    .join("\n");
  return `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1"><title>Twincell API</title>
<style>body{font:16px system-ui;background:#101315;color:#e8edf0;max-width:1000px;margin:32px auto;padding:0 16px}a{color:#3fb8b3}td{padding:6px 12px 6px 0;border-bottom:1px solid #2b3338;vertical-align:top}.wide{overflow-x:auto}code{white-space:nowrap}</style>
<h1>Twincell API</h1><p>Version ${API_VERSION}, served by Twincell ${escaped(version)}. SI units and radians; joints count from 1. Not a certified safety device.</p>
<ul><li><a href="/api/openapi.json">OpenAPI 3.1</a>: everything by HTTP</li><li><a href="/api/asyncapi.json">AsyncAPI 3.0</a>: the sockets <code>${SOCKETS.stream}</code> (state, read only) and <code>${SOCKETS.commands}</code> (commands with signs of life)</li><li><a href="/api/v1/robots">Open robots</a>, <a href="/api/v1/models">models</a>, <a href="/api/v1/drivers">drivers</a></li></ul>
<div class="wide"><table>${rows}</table></div></html>`;
}
