// `@twincell/core/catalogue`: the data apart from `@twincell/core`, so that a page can load them after its start.
export { CATALOGUE } from "../robots/catalogue/makers.ts";
