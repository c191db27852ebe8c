import { DRIVER_KINDS, kukaOverRsi, type DriverKind } from "@twincell/controllers";

/** Every brand, and the second way to one that apps do not offer by itself. */
export const SOAKED: readonly DriverKind[] = [...DRIVER_KINDS, kukaOverRsi];
