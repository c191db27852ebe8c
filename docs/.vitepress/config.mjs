// The documentation as a site: `npm run docs` builds it, `twincell serve` shows it at /docs/, without a network.
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vitepress";

const docs = fileURLToPath(new URL("..", import.meta.url));
const base = "/docs/";
const scripts = new Map();

/** Lists that have every word somewhere would stand before every answer. */
const UNSEARCHED = /^(public-api\/|requirements\.md)/;
/** The mark of the studio: a rounded teal square. */
const ICON = `data:image/svg+xml,${encodeURIComponent('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 16 16"><rect width="16" height="16" rx="3.5" fill="#3fb8b3"/></svg>')}`;

/** The pages of a folder by their first heading. */
const pagesOf = folder =>
  readdirSync(join(docs, folder))
    .filter(file => file.endsWith(".md") && file !== "README.md")
    .sort()
    .map(file => page(`${folder}/${file}`));
const titleOf = path => /^# (.+)$/m.exec(readFileSync(join(docs, path), "utf8"))?.[1] ?? path;
const page = (path, text = titleOf(path)) => ({ text, link: `/${path.replace(/(README)?\.md$/, "")}` });

/** Braces in text are braces, not Vue. */
function plainBraces(markdown) {
  const { text, code_inline: code } = markdown.renderer.rules;
  const plain = html => html.replaceAll("{{", "&#123;&#123;");
  markdown.renderer.rules.text = (...given) => plain(text(...given));
  markdown.renderer.rules.code_inline = (...given) => plain(code(...given));
}

/** Programs for controllers, which are handed out as they are. */
const HANDED_OUT = /(^|\/)TWINCELL\w*\.\w+$/;

/** What leads out of the documentation stays a name: sources and examples are in the repository. */
function linksInside(markdown) {
  const open = markdown.renderer.rules.link_open;
  markdown.renderer.rules.link_open = (tokens, at, ...rest) => {
    const href = tokens[at].attrGet("href") ?? "";
    if (HANDED_OUT.test(href)) return `<a href="${href}" download>`;
    if (/^(\.\.\/)+(examples|packages|apps|scripts|bench|clients|fixtures|README|CHANGELOG|LICENSE)/.test(href))
      tokens[at].attrs = [["title", href.replace(/^(\.\.\/)+/, "")]];
    return open(tokens, at, ...rest);
  };
}

/** Declarations of thousands of lines stay uncoloured: a mark for each word would weigh megabytes. */
function plainDeclarations(markdown) {
  const { fence } = markdown.renderer.rules;
  markdown.renderer.rules.fence = (tokens, at, options, env, self) =>
    env.relativePath?.startsWith("public-api/")
      ? `<div class="language-ts vp-adaptive-theme"><pre><code v-pre>${markdown.utils.escapeHtml(tokens[at].content)}</code></pre></div>`
      : fence(tokens, at, options, env, self);
}

export default defineConfig({
  title: "Twincell",
  description: "Teach, simulate, check and twin industrial robot cells.",
  lang: "en",
  head: [["link", { rel: "icon", href: ICON }]],
  base,
  cleanUrls: false,
  rewrites: { "README.md": "index.md", ":folder/README.md": ":folder/index.md" },
  lastUpdated: false,
  outDir: ".vitepress/dist",
  cacheDir: "../.cache/vitepress",
  markdown: {
    attrs: { disable: true },
    theme: { light: "github-light", dark: "github-dark" },
    config(markdown) {
      plainBraces(markdown);
      linksInside(markdown);
      plainDeclarations(markdown);
    },
  },
  // A page is allowed files of this server only: what stands in the page itself is moved into files.
  transformHtml: html =>
    html.replace(/<script(?: id="[^"]*")?>([^]*?)<\/script>/g, (_, text) => {
      const name = `inline-${createHash("sha256").update(text).digest("hex").slice(0, 12)}.js`;
      scripts.set(name, text);
      return `<script src="${base}assets/${name}"></script>`;
    }),
  buildEnd({ outDir }) {
    mkdirSync(join(outDir, "assets"), { recursive: true });
    for (const [name, text] of scripts) writeFileSync(join(outDir, "assets", name), text);
    for (const file of readdirSync(join(docs, "controllers")).filter(name => HANDED_OUT.test(name)))
      copyFileSync(join(docs, "controllers", file), join(outDir, "controllers", file));
  },
  themeConfig: {
    search: {
      provider: "local",
      options: {
        _render: (source, env, markdown) => (UNSEARCHED.test(env.relativePath) ? "" : markdown.render(source, env)),
      },
    },
    outline: [2, 3],
    sidebar: [
      {
        text: "Start",
        items: [
          page("start.md"),
          page("tour.md"),
          ...pagesOf("tutorials"),
          page("first-motion.md"),
          page("headsets.md"),
          page("glove.md"),
          page("text-programs.md"),
          page("robot-files.md"),
        ],
      },
      {
        text: "Robots of every maker",
        items: [page("controllers/README.md", "Controllers"), ...pagesOf("controllers"), page("vendors.md")],
      },
      { text: "Languages of robots", collapsed: true, items: pagesOf("languages") },
      {
        text: "In a plant",
        items: ["operations.md", "plant.md", "scale.md", "security.md", "recording/README.md", "dataset.md"].map(path =>
          page(path),
        ),
      },
      { text: "Programs beside it", items: ["cli.md", "api.md", "mcp.md"].map(path => page(path)) },
      {
        text: "For developers",
        collapsed: true,
        items: [
          "architecture.md",
          "conventions.md",
          "glossary.md",
          "add-a-robot.md",
          "add-a-dialect.md",
          "add-a-controller.md",
          "add-a-check.md",
          "add-a-file-format.md",
          "add-a-panel.md",
          "add-a-language.md",
        ]
          .filter(path => readdirSync(docs).includes(path))
          .map(path => page(path)),
      },
      { text: "Public API of the packages", collapsed: true, items: pagesOf("public-api") },
      {
        text: "The five papers",
        items: [page("papers/README.md", "Side by side"), ...pagesOf("papers"), page("requirements.md")],
      },
      { text: "Why it is built this way", collapsed: true, items: pagesOf("decisions") },
    ],
  },
});
