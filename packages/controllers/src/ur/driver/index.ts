export { createUrFace } from "./face.ts";
