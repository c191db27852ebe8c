/** What the second part of the table of drivers says, beside the rows. */
export type Ability = "texts" | "signals" | "override" | "payload" | "watch";

/**
 * A row of the requirements, or an ability, that a driver does not have, and why. The tests of the driver and
 * docs/controllers/README.md read the same list.
 */
export interface Cannot {
  readonly row: `T-${number}` | Ability;
  readonly because: string;
}
