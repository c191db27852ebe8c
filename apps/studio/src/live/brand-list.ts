import { BRANDS } from "@twincell/controllers";

/** What the dialog offers before any host was asked: brands with a virtual controller in the page. */
export const BRAND_LIST = BRANDS.map(({ id, name, vendor, data = [] }) => ({ id, name, vendor, data }));
