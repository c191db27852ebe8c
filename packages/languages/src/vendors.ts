import type { Dialect, MoveStep } from "@twincell/core";

const PATHS: readonly { readonly path: MoveStep["path"]; readonly title: string }[] = [
  { path: "ptp", title: "joint" }, { path: "lin", title: "straight" }, { path: "circ", title: "arc" }, { path: "spline", title: "spline" },
];

/** What each dialect declares, as tables in Markdown. What one cannot do stands below with its reason, in the words a user sees. */
export function vendorTables(dialects: readonly Dialect[]): string {
  const head = ["brand", "language", "id", ...PATHS.map(({ title }) => title), "writes", "reads", "executes", "standing", "files"];
  const rows = dialects.map(dialect => [
    dialect.brand, dialect.name, `\`${dialect.id}\``,
    ...PATHS.map(({ path }) => dialect.cannot.some(({ what }) => what === path) ? "–" : "✓"),
    "✓", "✓", "✓", dialect.maturity, dialect.extensions.map(extension => `\`${extension}\``).join(" "),
  ]);
  const table = [head, head.map(() => "---"), ...rows].map(cells => `| ${cells.join(" | ")} |`).join("\n");
  const reasons = dialects.map(({ name, cannot }) =>
    [`**${name}** cannot`, "", ...(cannot.length === 0 ? ["- nothing of what a program can say"] : cannot.map(({ what, because }) => `- ${what}: ${because}`))].join("\n"));
  return [table, ...reasons].join("\n\n");
}
