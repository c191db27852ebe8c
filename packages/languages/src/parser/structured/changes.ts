import type { Block } from "./tree.ts";

/** Names of data that some statement of these blocks gives a value: what else is declared stays as it is. */
export function changedNames(blocks: Iterable<Block>): ReadonlySet<string> {
  const names = new Set<string>();
  for (const block of blocks) note(block, names);
  return names;
}

function note(block: Block, into: Set<string>): void {
  for (const statement of block) {
    switch (statement.kind) {
      case "assign": {
        let { to } = statement;
        while (to.kind === "component" || to.kind === "index") to = to.of;
        if (to.kind === "variable") into.add(to.name);
        break;
      }
      case "if":
        for (const { body } of statement.branches) note(body, into);
        if (statement.otherwise !== undefined) note(statement.otherwise, into);
        break;
      case "while":
      case "for":
        note(statement.body, into);
        break;
      default:
        break;
    }
  }
}
