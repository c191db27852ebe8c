import { mkdir, readFile, writeFile } from "node:fs/promises";
import { networkInterfaces } from "node:os";
import { join } from "node:path";
import { generate } from "selfsigned";

/** IPv4 addresses other machines on the local network can use for this one. */
export function lanAddresses(): string[] {
  return Object.values(networkInterfaces())
    .flatMap(list => list ?? [])
    .filter(address => address.family === "IPv4" && !address.internal)
    .map(address => address.address);
}

export interface Certificate {
  readonly key: string;
  readonly cert: string;
}

/**
 * A certificate of our own for these addresses, kept in `folder` so that a headset has to be convinced only once.
 * Browsers warn about it; a headset session works after the warning is accepted.
 */
export async function certificate(folder: string | undefined, addresses: readonly string[]): Promise<Certificate> {
  const file = folder && join(folder, "certificate.json");
  if (file) {
    const kept = await readFile(file, "utf8").then(
      text => JSON.parse(text) as Certificate & { addresses: string[]; until: number },
      () => null,
    );
    if (kept && addresses.every(address => kept.addresses.includes(address)) && kept.until > Date.now()) return kept;
  }
  const days = 365;
  const made = await generate([{ name: "commonName", value: "Twincell" }], {
    keySize: 2048,
    algorithm: "sha256",
    notAfterDate: new Date(Date.now() + days * 86_400_000),
    extensions: [
      {
        name: "subjectAltName",
        altNames: [
          { type: 2, value: "localhost" },
          { type: 7, ip: "127.0.0.1" },
          ...addresses.map(ip => ({ type: 7 as const, ip })),
        ],
      },
    ],
  });
  const kept = { key: made.private, cert: made.cert, addresses, until: Date.now() + (days - 5) * 86_400_000 };
  if (file) {
    await mkdir(folder, { recursive: true });
    await writeFile(file, JSON.stringify(kept), { mode: 0o600 });
  }
  return kept;
}
