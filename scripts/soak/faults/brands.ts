import { BRANDS, kukaOverRsi, type Brand } from "@twincell/controllers";

/** Every brand, and the second way to one that apps do not offer by itself. */
export const SOAKED: readonly Brand[] = [...BRANDS, kukaOverRsi];
