/**
 * A number with that many digits after the point, halves to the even neighbour as IEEE 754 has it. Whether it is a half
 * is seen in the digits of the number itself: 2.675 is not.
 *
 * @param places  0 … 60.
 */
export function fixed(value: number, places: number): string {
  const near = value.toFixed(places);
  if (Math.abs(value) >= 1e21) return near;
  const long = value.toFixed(Math.min(100, places + 40));
  const point = long.indexOf(".");
  const rest = long.slice(point + 1 + places);
  const down = places === 0 ? long.slice(0, point) : long.slice(0, point + 1 + places);
  return /^50*$/.test(rest) && "02468".includes(down.at(-1) ?? "") ? down : near;
}
