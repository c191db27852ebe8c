import { createSocket } from "node:dgram";
import { createServer, type AddressInfo } from "node:net";

/** A port that nobody has: for programs that cannot be asked which one they took. */
export const freeDatagramPort = (host: string): Promise<number> =>
  new Promise(resolve => {
    const socket = createSocket("udp4");
    socket.bind(0, host, () => {
      const { port } = socket.address();
      socket.close(() => {
        resolve(port);
      });
    });
  });
export const freePort = (host: string): Promise<number> =>
  new Promise(resolve => {
    const server = createServer().listen(0, host, () => {
      const { port } = server.address() as AddressInfo;
      server.close(() => {
        resolve(port);
      });
    });
  });
