/**
 * The service worker of the studio: keeps every built file, by its hash, and answers from what it keeps. A new version
 * is fetched beside the old one and waits until the person says so; only what changed is fetched. One that took over
 * from a worker whose pages are broken does not wait: no page answers it, so it takes over and opens them again.
 *
 * @param files  path and hash of each.
 */
export function serviceWorkerText(version: string, files: readonly (readonly [string, string])[]): string {
  return `const VERSION = ${JSON.stringify(version)};
const FILES = ${JSON.stringify(files)};
const CACHE = "twincell-" + VERSION;
const ROOT = new URL("./", self.location).href;
const HASH = "x-twincell-hash";
const ANSWER_MS = 4000;

self.addEventListener("install", event => event.waitUntil(install()));
self.addEventListener("activate", event => event.waitUntil(activate()));
self.addEventListener("message", event => {
  if (event.data === "take-over") void self.skipWaiting();
});
self.addEventListener("fetch", event => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || !url.href.startsWith(ROOT)) return;
  // The access code of a server is for the server.
  if (event.request.mode === "navigate" && url.searchParams.has("code")) {
    event.respondWith(fetch(event.request).catch(() => kept(event.request, url).then(found => found ?? Response.error())));
    return;
  }
  event.respondWith(kept(event.request, url).then(found => found ?? fetch(event.request)));
});

async function kept(request, url) {
  const cache = await caches.open(CACHE);
  const plain = url.origin + url.pathname;
  const found = await cache.match(plain);
  if (found || request.mode !== "navigate") return found;
  return cache.match(plain.replace(/\\/?$/, "/index.html"));
}

async function install() {
  const cache = await caches.open(CACHE);
  const old = (await caches.keys()).filter(name => name.startsWith("twincell-") && name !== CACHE);
  for (const [path, hash] of FILES) {
    const url = ROOT + path;
    if ((await cache.match(url))?.headers.get(HASH) === hash) continue;
    await cache.put(url, (await sameFrom(old, url, hash)) ?? (await fetched(url, hash)));
  }
  if (self.registration.active && !(await pageAnswers())) {
    reopens = true;
    await self.skipWaiting();
  }
}
let reopens = false;

async function sameFrom(names, url, hash) {
  for (const name of names) {
    const found = await (await caches.open(name)).match(url);
    if (found?.headers.get(HASH) === hash) return found;
  }
  return undefined;
}
async function fetched(url, hash) {
  const got = await fetch(url, { cache: "no-cache" });
  if (!got.ok || got.redirected) throw new Error(url + " was answered with " + got.status);
  const headers = new Headers(got.headers);
  headers.set(HASH, hash);
  headers.delete("content-encoding");
  headers.delete("content-length");
  return new Response(await got.blob(), { status: 200, headers });
}

/** Whether one of the pages is a studio that works; true where none is open. */
async function pageAnswers() {
  const pages = await self.clients.matchAll({ type: "window", includeUncontrolled: true });
  if (pages.length === 0) return true;
  return new Promise(resolve => {
    setTimeout(() => resolve(false), ANSWER_MS);
    for (const page of pages) {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => resolve(true);
      page.postMessage("are-you-there", [port2]);
    }
  });
}

async function activate() {
  for (const name of await caches.keys())
    if (name.startsWith("twincell-") && name !== CACHE) await caches.delete(name);
  await self.clients.claim();
  if (!reopens) return;
  for (const page of await self.clients.matchAll({ type: "window" })) await page.navigate(page.url);
}
`;
}
