import { Refusal } from "../refusal.ts";
import { attributeOf, shorten, type Element } from "../xml.ts";
import { textOf, truthOf, type Value } from "./expression/values.ts";
import type { Scope } from "./scope.ts";

const NAME = /^(?!__)[A-Za-z_\u00c0-\uffff][\w\u00c0-\uffff]*$/;

/** Carries out an `xacro:property`: a value, a default, a block, or the removal of one. */
export function propertyInto(scope: Scope, element: Element, valueIn: (text: string, scope: Scope) => Value): void {
  const name = textOf(valueIn(attributeOf(element, "name", "A property"), scope));
  const { value, default: fallback, remove, scope: place, lazy_eval: lazy } = element.attributes;
  const flag = (written: string | undefined, otherwise: boolean): boolean =>
    written === undefined ? otherwise : truthOf(valueIn(written, scope), written);
  if (!NAME.test(name)) throw new Refusal(`“${shorten(name)}” cannot name a property.`);
  if (flag(remove, false)) {
    scope.remove(name);
    return;
  }
  if (value !== undefined && fallback !== undefined)
    throw new Refusal(`The property ${shorten(name)} has both a value and a default.`);
  if (fallback !== undefined && scope.has(name)) return;
  const text = value ?? fallback;
  const target = place === "global" ? scope.top() : place === "parent" ? scope.caller() : scope;
  if (place !== undefined && !["global", "parent", "local"].includes(place))
    throw new Refusal(`The property ${shorten(name)} has the scope “${shorten(place)}”; global and parent are known.`);
  if (!target) return;
  if (text === undefined) {
    target.setBlock(`**${name}`, element);
    return;
  }
  if (target === scope && flag(lazy, true)) target.set(name, text, true);
  else target.set(name, valueIn(text, scope), false);
}
