// In the place of ../connection in the page without a server: the other end is a worker of this page.

import type { ConnectionEvents, LinkState } from "../connection";
import { decodeServerMessage } from "../protocol";

export type { ConnectionEvents, LinkState };

const kScene = "teapot";

export class Connection {
  private readonly worker_ = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  private state_: LinkState = "connecting";

  constructor(_url: string, private readonly events_: ConnectionEvents) {
    this.worker_.onmessage = (event: MessageEvent<Uint8Array | string>) => this.receive(event.data);
    this.worker_.onerror = (event) => this.failed(event.message);
    this.worker_.postMessage({ scene: new URLSearchParams(location.search).get("scene") ?? kScene });
  }

  get state(): LinkState {
    return this.state_;
  }

  send(bytes: Uint8Array<ArrayBuffer>): void {
    this.worker_.postMessage(bytes);
  }

  private receive(data: Uint8Array | string): void {
    if (typeof data === "string") {
      this.failed(data);
      return;
    }
    if (this.state_ !== "live") {
      this.state_ = "live";
      this.events_.link("live");
    }
    this.events_.message(decodeServerMessage(data));
  }

  private failed(reason: string): void {
    this.events_.violation(reason);
  }
}
