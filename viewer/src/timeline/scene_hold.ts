// The live scene while something else is shown: what the server goes on sending of it, to be shown again as it is then.

import type { Hello } from "../gen/hl_pb";
import type { Incoming } from "../protocol";
import type { Layout, Mesh } from "../scene_messages";
import type { SceneStore } from "../scene_store";

export class SceneHold {
  private readonly meshes_: Map<number, Mesh>;
  private layout_: Layout | undefined;
  private hello_: Hello | undefined;

  constructor(store: SceneStore) {
    this.meshes_ = new Map(store.meshes);
    this.layout_ = store.layout;
  }

  take(message: Incoming): void {
    switch (message.kind) {
      case "hello":
        this.hello_ = message.hello;
        this.meshes_.clear();
        this.layout_ = undefined;
        break;
      case "mesh":
        this.meshes_.set(message.mesh.number, message.mesh);
        break;
      case "layout":
        this.layout_ = message.layout;
        break;
      case "forget":
        message.meshes.forEach((number) => this.meshes_.delete(number));
        break;
      default:
    }
  }

  /** What a page that has just come would be sent; without a greeting if the server is the same. */
  messages(): Incoming[] {
    const meshes = [...this.meshes_.values()].map((mesh): Incoming => ({ kind: "mesh", mesh }));
    return [
      ...(this.hello_ === undefined ? [] : [{ kind: "hello", hello: this.hello_ } as const]),
      ...meshes,
      ...(this.layout_ === undefined ? [] : [{ kind: "layout", layout: this.layout_ } as const]),
    ];
  }
}
