/**
 * The brand of a maker's own driver, a process that speaks these messages; and the port where it listens when none is
 * said (row T-60).
 */
export const PLUG_IN = "plug-in";
export const PLUG_IN_PORT = 7077;
