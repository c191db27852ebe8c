import { childOf, childrenOf, type Element } from "../xml.ts";
import { byId, numbersOf } from "./dae-geometry.ts";

/**
 * The diffuse colours of a COLLADA file: the symbol of a set of faces → bind_material → material → effect → diffuse
 * colour.
 *
 * @returns red, green, blue from 0 to 1; undefined where the material has none: a texture, or nothing at all.
 */
export function daeColors(
  root: Element,
): (symbol: string, instance: Element | undefined) => readonly [number, number, number] | undefined {
  const library = (name: string, of: string): readonly Element[] =>
    childrenOf(root, name).flatMap(each => childrenOf(each, of));
  const materials = library("library_materials", "material");
  const effects = library("library_effects", "effect");
  return (symbol, instance) => {
    const bound = descendants(instance, "instance_material").find(each => each.attributes["symbol"] === symbol);
    const material =
      byId(materials, bound?.attributes["target"]) ?? materials.find(each => each.attributes["id"] === symbol);
    const effect = material && byId(effects, childOf(material, "instance_effect")?.attributes["url"]);
    const diffuse = descendants(effect, "diffuse")[0];
    const written = diffuse && childOf(diffuse, "color");
    if (!written) return undefined;
    const [red, green, blue] = numbersOf(written.text, written);
    return red !== undefined && green !== undefined && blue !== undefined ? [red, green, blue] : undefined;
  };
}

function descendants(element: Element | undefined, name: string): readonly Element[] {
  return element ? element.children.flatMap(child => (child.name === name ? [child] : descendants(child, name))) : [];
}
