/**
 * The lines in and out of a controller by their names in the program. A line nobody has written to yet is false; an
 * analogue one reads 0.
 */
export interface Signals {
  read(signal: string): boolean | number;
  write(signal: string, value: boolean | number): void;
}
