import { networkInterfaces } from "node:os";

/** IPv4 addresses other machines on the local network can use for this one. */
export function lanAddresses(): string[] {
  return Object.values(networkInterfaces())
    .flatMap(list => list ?? [])
    .filter(address => address.family === "IPv4" && !address.internal)
    .map(address => address.address);
}
