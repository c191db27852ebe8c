import type { Pose } from "@twincell/core";

export type Attributes = Readonly<Record<string, string | number | readonly number[] | undefined>>;

/** One element of an MJCF text. Names are made here and never come from a person, so nothing needs escaping. */
export function element(tag: string, attributes: Attributes = {}, inside: readonly string[] = []): string {
  const written = Object.entries(attributes)
    .flatMap(([name, value]) =>
      value === undefined ? [] : [` ${name}="${typeof value === "object" ? value.join(" ") : value}"`],
    )
    .join("");
  return inside.length === 0 ? `<${tag}${written}/>` : `<${tag}${written}>\n${inside.join("\n")}\n</${tag}>`;
}

/** MuJoCo writes quaternions w first. */
export const placed = ({ position, quaternion: [x, y, z, w] }: Pose): Attributes => ({
  pos: position,
  quat: [w, x, y, z],
});
