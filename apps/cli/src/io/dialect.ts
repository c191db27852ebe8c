import { dialectById, DIALECTS } from "@twincell/languages";
import type { Dialect } from "@twincell/core";
import { UseFault } from "./usage.ts";

/** The dialect of that id; when none is named and only one reads files of that ending, that one. */
export function dialectOf(option: string, id: string | undefined, path = ""): Dialect {
  const ending = /\.[^./\\]+$/.exec(path)?.[0]?.toLowerCase() ?? "";
  const known =
    id === undefined
      ? DIALECTS.filter(dialect =>
          dialect.extensions.some(each => each.toLowerCase() === ending || `.${each.toLowerCase()}` === ending),
        )
      : [dialectById(id)];
  const [dialect] = known;
  if (dialect && known.length === 1) return dialect;
  throw new UseFault(
    id === undefined ? `--${option} is missing.` : `There is no dialect "${id}".`,
    `Dialects: ${DIALECTS.map(each => each.id).join(", ")}.`,
  );
}
