export { createStaubliFace, type StaubliFaceOptions } from "./face.ts";
