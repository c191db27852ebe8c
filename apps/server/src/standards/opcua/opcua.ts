import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { RobotState } from "../robot-states.ts";
import type { StandardContext, StartedStandard } from "../standard.ts";
import { createRobotModel } from "./robot-model.ts";

/** Fastest sampling and publishing that is granted [ms]; the library's own default would be 50. */
const FASTEST_MS = 10;
const MOST_SESSIONS = 20;

/**
 * An OPC UA server with the companion model for robots (OPC 40010-1, version 1.02): a motion device system for every
 * open robot. It only tells: nothing is written and no method moves a robot. On loopback everybody of this machine may
 * read; on a network only who names a token and its name, signed and encrypted.
 */
export async function startOpcua(context: StandardContext, port: number): Promise<StartedStandard> {
  const opcua = await import("node-opcua");
  const {
    MessageSecurityMode,
    MonitoredItem,
    nodesets,
    OPCUACertificateManager,
    OPCUAServer,
    SecurityPolicy,
    Subscription,
  } = opcua;
  Subscription.minimumPublishingInterval = FASTEST_MS;
  MonitoredItem.minimumSamplingInterval = FASTEST_MS;
  const own = context.data === undefined ? mkdtempSync(join(tmpdir(), "twincell-opcua-")) : null;
  const isOpen = context.certificate === null;
  const server = new OPCUAServer({
    port,
    ...(context.host === "0.0.0.0" ? {} : { host: context.host }),
    ...(isOpen ? { hostname: context.host } : {}),
    resourcePath: "/twincell",
    allowAnonymous: isOpen,
    maxConnectionsPerEndpoint: MOST_SESSIONS,
    securityModes: isOpen
      ? [MessageSecurityMode.None, MessageSecurityMode.SignAndEncrypt]
      : [MessageSecurityMode.SignAndEncrypt],
    securityPolicies: isOpen ? [SecurityPolicy.None, SecurityPolicy.Basic256Sha256] : [SecurityPolicy.Basic256Sha256],
    // Who may read is said by the token; the certificate of a client only encrypts.
    serverCertificateManager: new OPCUACertificateManager({
      rootFolder: own ?? join(context.data!, "opcua"),
      automaticallyAcceptUnknownCertificate: true,
    }),
    userManager: {
      isValidUser: (name: string, password: string) => {
        const answer = context.tokens(password);
        return answer.kind === "known" && answer.name === name;
      },
    },
    buildInfo: { productName: "Twincell", softwareVersion: context.version, manufacturerName: "Twincell" },
    serverInfo: { applicationName: { text: "Twincell" } },
    nodeset_filename: [nodesets.standard, nodesets.di, nodesets.ia, nodesets.robotics],
  });
  await server.initialize();
  const model = createRobotModel(opcua, server.engine.addressSpace!);
  const forget = context.states.listen({
    opened(robot: RobotState) {
      model.add(robot, context.version);
    },
    closed(robot) {
      model.remove(robot);
    },
    signals(robot) {
      model.lines(robot);
    },
  });
  await server.start();
  return {
    address: `OPC UA: opc.tcp://${context.host === "0.0.0.0" ? "127.0.0.1" : context.host}:${port}/twincell`,
    async close() {
      forget();
      await server.shutdown(0);
      if (own !== null) rmSync(own, { recursive: true, force: true });
    },
  };
}
