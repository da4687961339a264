// The worker with the engine, as the page sees it: messages of the protocol both ways, and scenes to load.

/** Triangles for the engine: 3 numbers a vertex, 3 indices a triangle. */
export interface MeshToLoad {
  readonly name: string;
  readonly positions: Float64Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
}

/** To the worker, besides the bytes of the protocol. */
export type Order =
  | { readonly load: number; readonly scene: string }
  | { readonly load: number; readonly mesh: MeshToLoad }
  | { readonly running: boolean };

/** What is loaded now. */
export interface Loaded {
  readonly triangles: number;
  readonly worldPerDevice: number;
}

/** From the worker, besides the bytes of the protocol. */
export type Word =
  | { readonly load: number; readonly loaded?: Loaded; readonly error?: string }
  | { readonly scenes: string };

export interface EngineEvents {
  bytes(message: Uint8Array): void;
  /** The names of the built-in scenes, as the engine lists them. */
  scenes(list: string): void;
  /** The worker itself does not work: without it there is nothing. */
  broken(reason: string): void;
}

export class EngineWorker {
  private readonly worker_ = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  private readonly waiting_ = new Map<number, { resolve(loaded: Loaded): void; reject(error: Error): void }>();
  private last_ = 0;

  listen(events: EngineEvents): void {
    this.worker_.onmessage = ({ data }: MessageEvent<Uint8Array | Word>) => {
      if (data instanceof Uint8Array) {
        events.bytes(data);
      } else if ("scenes" in data) {
        events.scenes(data.scenes);
      } else {
        this.answer(data);
      }
    };
    this.worker_.onerror = (event) => events.broken(event.message);
  }

  send(bytes: Uint8Array<ArrayBuffer>): void {
    this.worker_.postMessage(bytes);
  }

  /** A built-in scene or a mesh in the place of the scene; rejects in the engine's words, and the old scene stays. */
  load(scene: string | MeshToLoad): Promise<Loaded> {
    const load = ++this.last_;
    const order: Order = typeof scene === "string" ? { load, scene } : { load, mesh: scene };
    return new Promise((resolve, reject) => {
      this.waiting_.set(load, { resolve, reject });
      this.worker_.postMessage(order);
    });
  }

  /** Whether the engine's clock runs. */
  setRunning(running: boolean): void {
    const order: Order = { running };
    this.worker_.postMessage(order);
  }

  private answer({ load, loaded, error }: { load: number; loaded?: Loaded; error?: string }): void {
    const waiting = this.waiting_.get(load);
    this.waiting_.delete(load);
    if (loaded !== undefined) {
      waiting?.resolve(loaded);
    } else {
      waiting?.reject(new Error(error));
    }
  }
}

/** There is one engine in a page. */
export const engine = new EngineWorker();
