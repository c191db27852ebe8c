/** A line of texts between a host and one who commands: a socket, or a worker's port. */
export interface Channel {
  send(text: string): void;
  close(): void;
}
