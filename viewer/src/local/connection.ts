// In the place of ../connection in the page without a server: the other end is a worker of this page.

import type { ConnectionEvents, LinkState } from "../connection";
import { decodeServerMessage } from "../protocol";
import { engine } from "./engine_worker";
import { ScenePicker } from "./scene_picker";

export type { ConnectionEvents, LinkState };

const kScene = "teapot";

export class Connection {
  private state_: LinkState = "connecting";
  private readonly picker_ = new ScenePicker((name) => this.pick(name));

  constructor(_url: string, private readonly events_: ConnectionEvents) {
    engine.listen({
      bytes: (bytes) => this.receive(bytes),
      scenes: (list) => this.picker_.show(list),
      broken: (reason) => events_.violation(reason),
    });
    void this.begin(new URLSearchParams(location.search).get("scene") ?? kScene);
    followVisibility();
  }

  get state(): LinkState {
    return this.state_;
  }

  send(bytes: Uint8Array<ArrayBuffer>): void {
    engine.send(bytes);
  }

  /** A scene of the address that does not exist is reported, and the page has one all the same. */
  private async begin(name: string): Promise<void> {
    const loaded = await this.pick(name);
    if (!loaded && name !== kScene) await this.pick(kScene);
  }

  private async pick(name: string): Promise<boolean> {
    try {
      await engine.load(name);
      return true;
    } catch (error) {
      this.picker_.select(undefined);
      this.events_.refused((error as Error).message);
      return false;
    }
  }

  private receive(bytes: Uint8Array): void {
    if (this.state_ !== "live") {
      this.state_ = "live";
      this.events_.link("live");
    }
    const message = decodeServerMessage(bytes);
    if (message.kind === "layout") this.picker_.select(message.layout.name);
    this.events_.message(message);
  }
}

/** Nobody touches what nobody sees: a hidden page stops the engine's clock, and its title says so. */
function followVisibility(): void {
  const title = document.title;
  document.addEventListener("visibilitychange", () => {
    engine.setRunning(!document.hidden);
    document.title = document.hidden ? `${title}: stopped while hidden` : title;
  });
}
