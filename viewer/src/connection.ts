// The WebSocket to the server: decodes what comes, and comes back by itself after a loss. The timing rules are in
// reconnect.ts; this file only turns them into sockets and timers.

import { decodeServerMessage, type Incoming } from "./protocol";
import { liveness, ReconnectPolicy } from "./reconnect";
import { ProtocolError } from "./wire_values";

export type LinkState = "connecting" | "live" | "silent" | "lost";

export interface ConnectionEvents {
  /** One decoded message; called in the order of arrival. */
  message(message: Incoming): void;
  /** The state of the link changed. */
  link(state: LinkState): void;
  /** The server sent something that breaks the protocol; the connection is closed and tried again. */
  violation(reason: string): void;
  /** What the user asked for is not possible; everything stays as it was. */
  refused(line: string): void;
}

const kWatch_ms = 250;

export class Connection {
  private readonly url_: string;
  private readonly events_: ConnectionEvents;
  private readonly policy_ = new ReconnectPolicy();
  private socket_: WebSocket | undefined;
  private state_: LinkState = "connecting";
  private heard_ms_ = 0;

  constructor(url: string, events: ConnectionEvents) {
    this.url_ = url;
    this.events_ = events;
    this.open();
    setInterval(() => this.watch(), kWatch_ms);
  }

  get state(): LinkState {
    return this.state_;
  }

  /** Sends when the link is open; otherwise the message is dropped, as it would be stale by then. */
  send(bytes: Uint8Array<ArrayBuffer>): void {
    if (this.socket_?.readyState === WebSocket.OPEN) {
      this.socket_.send(bytes);
    }
  }

  private open(): void {
    const socket = new WebSocket(this.url_);
    socket.binaryType = "arraybuffer";
    this.socket_ = socket;
    this.heard_ms_ = performance.now();
    socket.onmessage = (event: MessageEvent<unknown>) => this.receive(socket, event.data);
    socket.onclose = () => this.closed(socket);
  }

  private receive(socket: WebSocket, data: unknown): void {
    if (socket !== this.socket_ || !(data instanceof ArrayBuffer)) {
      return;
    }
    this.heard_ms_ = performance.now();
    this.policy_.succeeded();
    this.setState("live");
    let message: Incoming;
    try {
      message = decodeServerMessage(new Uint8Array(data));
    } catch (error) {
      this.events_.violation(error instanceof ProtocolError ? error.message : String(error));
      socket.close();
      return;
    }
    this.events_.message(message);
  }

  private closed(socket: WebSocket): void {
    if (socket !== this.socket_) {
      return;
    }
    this.socket_ = undefined;
    this.setState("lost");
    setTimeout(() => this.open(), this.policy_.nextDelay());
  }

  /** Finds a server that keeps the connection but says nothing. A hidden page is not judged: browsers slow it down. */
  private watch(): void {
    const socket = this.socket_;
    if (socket === undefined || document.hidden) {
      this.heard_ms_ = performance.now();
      return;
    }
    const verdict = liveness(performance.now() - this.heard_ms_);
    if (verdict === "gone") {
      socket.close();
      this.closed(socket);
    } else if (verdict === "silent" && this.state_ === "live") {
      this.setState("silent");
    }
  }

  private setState(state: LinkState): void {
    if (state !== this.state_) {
      this.state_ = state;
      this.events_.link(state);
    }
  }
}
