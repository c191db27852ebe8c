/** What a single-precision number holds: seven significant digits. */
const DIGITS = 7;

/**
 * A number as a single-precision controller prints it: rounded to single precision, then to seven significant digits,
 * decimal point, no exponent, no trailing zeros, no minus before zero.
 *
 * @throws {RangeError} when the number is not finite: nobody may write that into a program.
 */
export function singleText(value: number): string {
  const single = Math.fround(value);
  if (!Number.isFinite(single)) throw new RangeError(`${value} cannot be written in single precision.`);
  return decimalText(single, DIGITS);
}

/** A number with that many significant digits, without exponent and without trailing zeros. */
export function decimalText(value: number, digits: number): string {
  const [mantissa, exponent] = Math.abs(value)
    .toExponential(digits - 1)
    .split("e") as [string, string];
  const figures = mantissa.replace(".", "").replace(/0+$/, "");
  if (figures === "") return "0";
  const point = Number(exponent) + 1;
  const whole = point > 0 ? figures.slice(0, point).padEnd(point, "0") : "0";
  const fraction = point > 0 ? figures.slice(point) : "0".repeat(-point) + figures;
  return `${value < 0 ? "-" : ""}${whole}${fraction === "" ? "" : `.${fraction}`}`;
}
