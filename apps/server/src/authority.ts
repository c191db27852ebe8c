import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { PlainFault } from "@twincell/core";
import {
  AuthorityKeyIdentifierExtension,
  BasicConstraintsExtension,
  ExtendedKeyUsageExtension,
  Extension,
  KeyUsageFlags,
  KeyUsagesExtension,
  SubjectAlternativeNameExtension,
  SubjectKeyIdentifierExtension,
  X509Certificate,
  X509CertificateGenerator,
} from "@peculiar/x509";

/** PEM texts of a server's certificate with its authority's, and of its key. */
export interface Certificate {
  readonly key: string;
  readonly cert: string;
  /** The authority that a device may trust, as PEM. */
  readonly authority: string;
}
interface Kept {
  readonly key: string;
  readonly cert: string;
  readonly until: number;
}

const DAY_MS = 86_400_000;
const AUTHORITY_DAYS = 3650;
/** Apple's devices trust no server's certificate that is valid for longer than 825 days, whoever signed it. */
const SERVER_DAYS = 365;
const RENEW_DAYS = 5;
const ALGORITHM = { name: "ECDSA", namedCurve: "P-256", hash: "SHA-256" } as const;
const SERVER_AUTH = "1.3.6.1.5.5.7.3.1";
const NAME_CONSTRAINTS = "2.5.29.30";

/**
 * What the authority may sign for, as address and mask: private networks, link-local and loopback. Whoever steals its
 * key can still not pass for a site of the internet.
 */
const NETWORKS = [
  [10, 0, 0, 0, 255, 0, 0, 0],
  [172, 16, 0, 0, 255, 240, 0, 0],
  [192, 168, 0, 0, 255, 255, 0, 0],
  [169, 254, 0, 0, 255, 255, 0, 0],
  [127, 0, 0, 0, 255, 0, 0, 0],
] as const;

/** One element in DER: tag, length below 128, content. */
const der = (tag: number, content: readonly number[]): number[] => [tag, content.length, ...content];
/** NameConstraints of RFC 5280, 4.2.1.10: permitted subtrees of IP addresses, and of the name "localhost". */
function nameConstraints(addresses: readonly string[]): Extension {
  // An address outside of the private networks is one that this machine has: it alone is added.
  const own = addresses
    .filter(address => !isPrivate(address))
    .map(address => [...address.split(".").map(Number), 255, 255, 255, 255]);
  const subtrees = [
    ...[...NETWORKS, ...own].map(network => der(0x30, der(0x87, network))),
    der(0x30, der(0x82, [...new TextEncoder().encode("localhost")])),
  ].flat();
  const length = subtrees.length < 128 ? [subtrees.length] : [0x81, subtrees.length];
  const permitted = [0xa0, ...length, ...subtrees];
  const outer = permitted.length < 128 ? [permitted.length] : [0x81, permitted.length];
  return new Extension(NAME_CONSTRAINTS, true, Uint8Array.from([0x30, ...outer, ...permitted]));
}
const isPrivate = (address: string): boolean => {
  const bytes = address.split(".").map(Number);
  return NETWORKS.some(network => [0, 1, 2, 3].every(i => (bytes[i]! & network[4 + i]!) === network[i]));
};

/** @throws PlainFault when the file is there and damaged: what devices trust is not made anew behind their back */
async function kept(file: string | undefined): Promise<unknown> {
  if (file === undefined) return null;
  const text = await readFile(file, "utf8").catch(() => null);
  if (text === null) return null;
  try {
    return JSON.parse(text) as unknown;
  } catch {
    throw new PlainFault(
      "certificate.damaged",
      `${file} cannot be read: it is no JSON.`,
      "Delete it; a new authority is made, which devices have to trust again.",
    );
  }
}
const isKept = (value: unknown): value is Kept =>
  typeof value === "object" &&
  value !== null &&
  typeof Reflect.get(value, "key") === "string" &&
  typeof Reflect.get(value, "cert") === "string" &&
  Number(Reflect.get(value, "until")) > Date.now();

async function keep(folder: string | undefined, name: string, value: unknown): Promise<void> {
  if (folder === undefined) return;
  await mkdir(folder, { recursive: true });
  await writeFile(join(folder, name), JSON.stringify(value), { mode: 0o600 });
}

const newKeys = () => crypto.subtle.generateKey(ALGORITHM, true, ["sign", "verify"]);
async function keyPem(key: Awaited<ReturnType<typeof newKeys>>["privateKey"]): Promise<string> {
  const text = Buffer.from(await crypto.subtle.exportKey("pkcs8", key)).toString("base64");
  return `-----BEGIN PRIVATE KEY-----\n${text.match(/.{1,64}/g)!.join("\n")}\n-----END PRIVATE KEY-----\n`;
}
const serial = (): string =>
  Buffer.from(crypto.getRandomValues(new Uint8Array(8)))
    .toString("hex")
    .replace(/^./, "1");

async function makeAuthority(name: string, addresses: readonly string[]): Promise<Kept> {
  const keys = await newKeys();
  const until = Date.now() + AUTHORITY_DAYS * DAY_MS;
  const cert = await X509CertificateGenerator.createSelfSigned({
    serialNumber: serial(),
    name: `CN=Twincell on ${name.replaceAll(/[^\w.-]/g, "-")}`,
    notBefore: new Date(Date.now() - DAY_MS),
    notAfter: new Date(until),
    signingAlgorithm: ALGORITHM,
    keys,
    extensions: [
      new BasicConstraintsExtension(true, 0, true),
      new KeyUsagesExtension(KeyUsageFlags.keyCertSign | KeyUsageFlags.cRLSign, true),
      await SubjectKeyIdentifierExtension.create(keys.publicKey),
      nameConstraints(addresses),
    ],
  });
  return { key: await keyPem(keys.privateKey), cert: cert.toString("pem"), until };
}

/**
 * A certificate for these addresses, signed by an authority of this machine, both kept in `folder`: a device that was
 * told to trust the authority once shows no warning, and goes on trusting it when an address changes. Without a folder
 * both are made anew each time.
 *
 * @param addresses IPv4, as other machines reach this one
 * @param name      of this machine, to be told apart in a device's list of authorities
 */
export async function certificate(
  folder: string | undefined,
  addresses: readonly string[],
  name: string,
): Promise<Certificate> {
  const file = folder && join(folder, "authority.json");
  const known = await kept(file);
  const allowed = Array.isArray(Reflect.get(Object(known) as object, "addresses"))
    ? (Reflect.get(Object(known) as object, "addresses") as unknown[])
    : [];
  const usable = isKept(known) && addresses.every(address => isPrivate(address) || allowed.includes(address));
  const authority = usable ? known : await makeAuthority(name, addresses);
  if (!usable) await keep(folder, "authority.json", { ...authority, addresses });
  const before = await kept(folder && join(folder, "certificate.json"));
  if (usable && isKept(before) && covers(before.cert, addresses))
    return { key: before.key, cert: before.cert, authority: authority.cert };
  const keys = await newKeys();
  const issuer = new X509Certificate(authority.cert);
  const body = authority.key.replaceAll(/-----[^-]+-----|\s/g, "");
  const signingKey = await crypto.subtle.importKey("pkcs8", Buffer.from(body, "base64"), ALGORITHM, false, ["sign"]);
  const cert = await X509CertificateGenerator.create({
    serialNumber: serial(),
    subject: "CN=Twincell",
    issuer: issuer.subject,
    notBefore: new Date(Date.now() - DAY_MS),
    notAfter: new Date(Date.now() + SERVER_DAYS * DAY_MS),
    signingAlgorithm: ALGORITHM,
    publicKey: keys.publicKey,
    signingKey,
    extensions: [
      new BasicConstraintsExtension(false, undefined, true),
      new KeyUsagesExtension(KeyUsageFlags.digitalSignature, true),
      new ExtendedKeyUsageExtension([SERVER_AUTH]),
      await SubjectKeyIdentifierExtension.create(keys.publicKey),
      await AuthorityKeyIdentifierExtension.create(issuer),
      new SubjectAlternativeNameExtension([
        { type: "dns", value: "localhost" },
        { type: "ip", value: "127.0.0.1" },
        ...addresses.map(value => ({ type: "ip" as const, value })),
      ]),
    ],
  });
  const made: Kept = {
    key: await keyPem(keys.privateKey),
    cert: `${cert.toString("pem")}\n${authority.cert}\n`,
    until: Date.now() + (SERVER_DAYS - RENEW_DAYS) * DAY_MS,
  };
  await keep(folder, "certificate.json", made);
  return { key: made.key, cert: made.cert, authority: authority.cert };
}

function covers(pem: string, addresses: readonly string[]): boolean {
  const names = new X509Certificate(
    pem.split("-----END CERTIFICATE-----")[0] + "-----END CERTIFICATE-----",
  ).getExtension(SubjectAlternativeNameExtension);
  const has = new Set(names?.names.items.map(({ value }) => value));
  return addresses.every(address => has.has(address));
}
