import { BRANDS, robotsOf } from "@twincell/controllers";

/** What the dialog offers before any host was asked: brands with a virtual controller in the page. */
export const BRAND_LIST = BRANDS.map(brand => ({ id: brand.id, name: brand.name, data: brand.data ?? [], robots: robotsOf(brand) }));
