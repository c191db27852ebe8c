/** A triangle mesh [m]: 3 numbers a vertex, 3 indices a triangle. Whoever is lent one does not write to it. */
export interface TriangleMesh {
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
}
