import type { Block, Routine } from "./tree.ts";

/** Names of data that some statement of these blocks gives a value: what else is declared stays as it is. */
export function changedNames(blocks: Iterable<Block>, routines?: ReadonlyMap<string, Routine>): ReadonlySet<string> {
  const names = new Set<string>();
  const handsBack = new Set(
    [...(routines?.values() ?? [])]
      .filter(({ parameters }) => parameters.some(each => each.isBack))
      .map(each => each.name),
  );
  for (const block of blocks) note(block, names, handsBack);
  return names;
}

function note(block: Block, into: Set<string>, handsBack: ReadonlySet<string>): void {
  for (const statement of block) {
    switch (statement.kind) {
      case "assign": {
        let { to } = statement;
        while (to.kind === "component" || to.kind === "index") to = to.of;
        if (to.kind === "variable") into.add(to.name);
        break;
      }
      case "do":
        // A routine may change what it is given.
        if (handsBack.has(statement.name))
          for (const { value } of statement.args) {
            let of = value;
            while (of?.kind === "component" || of?.kind === "index") ({ of } = of);
            if (of?.kind === "variable") into.add(of.name);
          }
        break;
      case "if":
        for (const { body } of statement.branches) note(body, into, handsBack);
        if (statement.otherwise !== undefined) note(statement.otherwise, into, handsBack);
        break;
      case "while":
      case "for":
        note(statement.body, into, handsBack);
        break;
      default:
        break;
    }
  }
}
