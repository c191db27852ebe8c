export { createCs7Adapter, type Cs7FaceOptions } from "./adapter.ts";
