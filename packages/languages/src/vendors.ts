import type { Capability, Dialect, MoveStep } from "@twincell/core";

const PATHS: readonly { readonly path: MoveStep["path"]; readonly title: string }[] = [
  { path: "ptp", title: "joint" },
  { path: "lin", title: "straight" },
  { path: "circ", title: "arc" },
  { path: "spline", title: "spline" },
];

/** What a program can say besides where it goes, under the heads of the second table. */
const CAPABILITIES: readonly { readonly title: string; readonly all: readonly Capability[] }[] = [
  { title: "loops", all: ["repeat"] },
  { title: "decisions", all: ["if"] },
  { title: "loops with a condition", all: ["while"] },
  { title: "variables", all: ["assign"] },
  { title: "expressions", all: ["expression"] },
  { title: "calls", all: ["call"] },
  { title: "arguments", all: ["arguments"] },
  { title: "pallets", all: ["pallet"] },
  { title: "digital out", all: ["set-digital"] },
  { title: "pulse", all: ["pulse"] },
  { title: "analogue out", all: ["set-analogue"] },
  { title: "wait for a line", all: ["wait-for"] },
  { title: "for an expression", all: ["wait-expression"] },
  { title: "with a time limit", all: ["timeout"] },
  { title: "steps when late", all: ["late"] },
  { title: "analogue in", all: ["read-analogue"] },
  { title: "search", all: ["search"] },
  { title: "load", all: ["payload"] },
  { title: "acceleration", all: ["acceleration"] },
  { title: "duration", all: ["duration"] },
  { title: "message", all: ["message"] },
  { title: "skips what is unknown", all: [] },
];

/**
 * What each dialect declares, as tables in Markdown. What is written with other statements, as
 * programmers of the language do, is marked ≈; what one cannot do stands below with its reason, in the words a user
 * sees.
 */
export function vendorTables(dialects: readonly Dialect[]): string {
  const head = [
    "brand",
    "language",
    "id",
    ...PATHS.map(({ title }) => title),
    "writes",
    "reads",
    "executes",
    "standing",
    "files",
  ];
  const rows = dialects.map(dialect => [
    dialect.brand,
    dialect.name,
    `\`${dialect.id}\``,
    ...PATHS.map(({ path }) => (dialect.cannot.some(({ what }) => what === path) ? "–" : "✓")),
    "✓",
    "✓",
    "✓",
    dialect.maturity,
    dialect.extensions.map(extension => `\`${extension}\``).join(" "),
  ]);
  const table = [head, head.map(() => "---"), ...rows].map(cells => `| ${cells.join(" | ")} |`).join("\n");
  const can = [
    ["language", ...CAPABILITIES.map(({ title }) => title)],
    ["---", ...CAPABILITIES.map(() => "---")],
    ...dialects.map(({ name, cannot, idioms = [], lines }) => [
      name,
      ...CAPABILITIES.map(({ all }) =>
        (all.length === 0 ? lines !== undefined : all.every(each => cannot.every(({ what }) => what !== each)))
          ? all.some(each => idioms.includes(each))
            ? "≈"
            : "✓"
          : "–",
      ),
    ]),
  ]
    .map(cells => `| ${cells.join(" | ")} |`)
    .join("\n");
  const reasons = dialects.map(({ name, cannot }) =>
    [
      `**${name}** cannot`,
      "",
      ...(cannot.length === 0
        ? ["- nothing of what a program can say"]
        : cannot.map(({ what, because }) => `- ${what}: ${because}`)),
    ].join("\n"),
  );
  return [table, can, ...reasons].join("\n\n");
}
