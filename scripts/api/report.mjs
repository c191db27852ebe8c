// What the packages offer to others, name by name with its declaration: docs/public-api, one file a package. The
// declarations are those the compiler emits, without comments; a change of the public API is seen in a review.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import ts from "typescript";

const root = fileURLToPath(new URL("../../", import.meta.url));
export const reportFolder = new URL("../../docs/public-api/", import.meta.url);

/** Packages with their entry files: `{ name, entries: [[".", "src/index.ts"], …] }`, testing doors apart. */
function packages() {
  return readdirSync(join(root, "packages"))
    .sort()
    .map(folder => {
      const { name, exports } = JSON.parse(readFileSync(join(root, "packages", folder, "package.json"), "utf8"));
      const entries = Object.entries(exports).filter(([path]) => path !== "./testing");
      return { name, folder, entries };
    });
}

/** Emits the declarations of every package into a folder, which is returned. */
function emitDeclarations(found) {
  const cache = join(root, "out");
  mkdirSync(cache, { recursive: true });
  const folder = mkdtempSync(join(cache, "api-"));
  const config = join(folder, "tsconfig.json");
  const files = found.flatMap(({ folder: name, entries }) =>
    entries.map(([, entry]) => join(root, "packages", name, entry)),
  );
  writeFileSync(
    config,
    JSON.stringify({
      extends: relative(folder, join(root, "tsconfig.base.json")),
      compilerOptions: {
        noEmit: false,
        incremental: false,
        emitDeclarationOnly: true,
        declaration: true,
        removeComments: true,
        rootDir: root,
        outDir: join(folder, "d"),
        lib: ["ES2023", "DOM"],
      },
      files,
    }),
  );
  const compiler = join(root, "node_modules/typescript7/bin/tsc");
  const result = spawnSync(process.execPath, [compiler, "-p", config], { cwd: root, encoding: "utf8" });
  if (result.status !== 0) throw new Error(`Declarations could not be emitted:\n${result.stdout}${result.stderr}`);
  return folder;
}

/** Reads emitted declarations and follows what a file passes on from others. */
class Declarations {
  #files = new Map();

  file(path) {
    let known = this.#files.get(path);
    if (!known) {
      known = ts.createSourceFile(path, readFileSync(path, "utf8"), ts.ScriptTarget.ES2023, true);
      this.#files.set(path, known);
    }
    return known;
  }

  /** The file that a relative name of another file stands for. */
  #next(from, specifier) {
    return join(dirname(from), specifier.replace(/\.ts$/, ".d.ts"));
  }

  /** Declarations by exported name. */
  exportsOf(path, seen = new Set()) {
    const found = new Map();
    if (seen.has(path)) return found;
    seen.add(path);
    for (const statement of this.file(path).statements) {
      if (ts.isExportDeclaration(statement)) this.#passedOn(path, statement, found, seen);
      else for (const name of exportedNames(statement)) found.set(name, [...(found.get(name) ?? []), statement]);
    }
    return found;
  }

  #passedOn(path, statement, found, seen) {
    const specifier = statement.moduleSpecifier?.text;
    if (specifier !== undefined && !specifier.startsWith(".")) {
      for (const each of statement.exportClause?.elements ?? []) found.set(each.name.text, [statement]);
      return;
    }
    const source = specifier === undefined ? null : this.#next(path, specifier);
    if (!statement.exportClause) {
      for (const [name, all] of this.exportsOf(source, seen)) found.set(name, all);
      return;
    }
    if (ts.isNamespaceExport(statement.exportClause)) {
      found.set(statement.exportClause.name.text, [statement]);
      return;
    }
    const theirs = source ? this.exportsOf(source, new Set()) : this.#locals(path);
    for (const { name, propertyName } of statement.exportClause.elements)
      found.set(name.text, theirs.get((propertyName ?? name).text) ?? [statement]);
  }

  #locals(path) {
    const found = new Map();
    for (const statement of this.file(path).statements)
      for (const name of declaredNames(statement)) found.set(name, [...(found.get(name) ?? []), statement]);
    return found;
  }
}

function declaredNames(statement) {
  if (ts.isVariableStatement(statement))
    return statement.declarationList.declarations.map(({ name }) => name.getText());
  return statement.name ? [statement.name.getText()] : [];
}
const exportedNames = statement =>
  statement.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword) ? declaredNames(statement) : [];

const textOf = statement =>
  statement
    .getText()
    .replace(/^export (declare )?/, "")
    .replaceAll("\r", "")
    .replace(/^( {4})+/gm, indent => "  ".repeat(indent.length / 4));

function section(title, declarations) {
  const names = [...declarations.keys()].sort((a, b) => (a < b ? -1 : a > b ? 1 : 0));
  const texts = names.flatMap(name => [...new Set(declarations.get(name).map(textOf))]);
  return `## ${title}\n\n${names.length} names.\n\n\`\`\`ts\n${texts.join("\n")}\n\`\`\`\n`;
}

/** The report of every package by its file name. */
export function publicApiReports() {
  const found = packages();
  const folder = emitDeclarations(found);
  try {
    const declarations = new Declarations();
    return new Map(
      found.map(({ name, folder: short, entries }) => {
        const emitted = entry => join(folder, "d/packages", short, entry.replace(/\.ts$/, ".d.ts"));
        // A package whose parts have doors of their own is told part by part.
        const parts = entries.length > 2 ? entries.filter(([path]) => path !== ".") : entries;
        const sections = parts.map(([path, entry]) =>
          section(path === "." ? name : `${name}/${path.slice(2)}`, declarations.exportsOf(emitted(entry))),
        );
        const intro =
          "What others may import, as the compiler declares it. Written by `node scripts/write-api.mjs`; a test holds it to the sources.";
        return [`${short}.md`, `# ${name}\n\n${intro}\n\n${sections.join("\n")}`];
      }),
    );
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
