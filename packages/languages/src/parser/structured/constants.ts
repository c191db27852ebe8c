import type { Block, Routine } from "./tree.ts";

/** Variables that are given a value once, outside every loop and branch: they mean the same wherever they stand. */
export function constantsOf(main: Block, routines: Iterable<Routine>): ReadonlySet<string> {
  const once = new Set<string>();
  const more = new Set<string>();
  const look = (block: Block, isTop: boolean): void => {
    for (const statement of block) {
      switch (statement.kind) {
        case "assign": {
          const name =
            statement.to.kind === "variable"
              ? statement.to.name
              : statement.to.kind === "index" && statement.to.of.kind === "variable"
                ? statement.to.of.name
                : "";
          if (!isTop || once.has(name) || statement.to.kind !== "variable") more.add(name);
          once.add(name);
          break;
        }
        case "if":
          for (const { body } of statement.branches) look(body, false);
          if (statement.otherwise !== undefined) look(statement.otherwise, false);
          break;
        case "while":
          look(statement.body, false);
          break;
        case "for":
          more.add(statement.variable);
          look(statement.body, false);
          break;
        default:
          break;
      }
    }
  };
  look(main, true);
  for (const { body, parameters } of routines) {
    for (const { name } of parameters) more.add(name);
    look(body, false);
  }
  return new Set([...once].filter(name => !more.has(name)));
}
