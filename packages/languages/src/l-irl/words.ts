import type { Capability } from "@twincell/core";

/** What a flat list of poses has no line for. */
export const CANNOT: readonly { readonly what: Capability; readonly because: string }[] = [
  { what: "search", because: "The pose list reads no signals, so a motion cannot end at one." },
  { what: "payload", because: "The pose list says where the tool goes, not what it carries." },
  { what: "wait-for", because: "The pose list reads no signals; it waits for a time only." },
  { what: "timeout", because: "The pose list waits for a time only." },
  { what: "set-digital", because: "The pose list has no lines besides the gripper." },
  { what: "set-analogue", because: "The pose list has no lines besides the gripper." },
  { what: "pulse", because: "The pose list has no lines besides the gripper." },
  { what: "read-analogue", because: "The pose list reads no signals." },
  { what: "repeat", because: "The pose list is read once from the first line to the last and has no loops." },
  { what: "while", because: "The pose list is read once from the first line to the last and has no loops." },
  { what: "assign", because: "The pose list computes nothing." },
  { what: "expression", because: "The pose list computes nothing." },
  { what: "wait-expression", because: "The pose list computes nothing." },
  { what: "late", because: "The pose list reads no signals." },
  { what: "arguments", because: "The pose list has no routines." },
  { what: "if", because: "The pose list decides nothing." },
  { what: "call", because: "The pose list has no routines." },
  { what: "pallet", because: "The pose list has no loops, and a pallet is not written out as copies." },
  { what: "message", because: "The pose list speaks to nobody while it runs; it has comments." },
  { what: "stop", because: "The pose list ends with its last line and nowhere before." },
];
