import { describeNetwork } from "@twincell/controllers/testing";
import { setTimeout as pause } from "node:timers/promises";
import { nodeNetwork } from "./node-network.ts";

describeNetwork("the system's sockets", () => ({
  network: nodeNetwork(),
  close() {
    /* The sockets are the tests' own. */
  },
  async until(so) {
    for (let i = 0; i < 2000 && !so(); i++) await pause(2);
    if (!so()) throw new Error("It never came about.");
  },
}));
