/**
 * The name under which a value stands in a table: one that is there already keeps its name, another is added under the
 * wanted one, with a number where that is taken by something else.
 *
 * @param joint  between the name and the number.
 */
export function nameIn<T>(table: Record<string, T>, value: T, wanted: string, joint: string): string {
  const text = JSON.stringify(value);
  for (let i = 1; ; i++) {
    const name = i === 1 ? wanted : `${wanted}${joint}${i}`;
    const known = Object.hasOwn(table, name) ? table[name] : undefined;
    if (known === undefined) table[name] = value;
    if (known === undefined || JSON.stringify(known) === text) return name;
  }
}
