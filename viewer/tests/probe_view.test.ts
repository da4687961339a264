import { create } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { StateSchema } from "../src/gen/hl_pb";
import { ProbeView } from "../src/probe_view";

const at = (y: number) => ({ x: 0, y, z: 0 });
const touching = create(StateSchema, { finger: at(0), proxy: at(0.001), forceN: at(1) });

describe("a probe", () => {
  // Its spot has no place and no size of its own then: it would cover the whole picture.
  test("shows no line down until it gets where that ends", () => {
    const probe = new ProbeView();
    probe.update(touching);
    expect(probe.drop.group.visible).toBe(false);
    probe.drop.update(at(0.001), { point: at(-1), normal: at(1) }, 0.002, 1e-4);
    probe.update(touching);
    expect(probe.drop.group.visible).toBe(true);
    probe.update(create(StateSchema, { finger: at(0) }));
    expect(probe.drop.group.visible).toBe(false);
  });

  test("shows the stylus of a device that has one, while it is wanted", () => {
    const probe = new ProbeView();
    probe.update(touching);
    expect(probe.stylus.group.visible).toBe(false);
    const turned = create(StateSchema, {
      finger: at(0), proxy: at(0.001), forceN: at(1), stylus: { rotation: { x: 0, y: 0, z: 0.6, w: 0.8 } },
    });
    probe.update(turned);
    expect(probe.stylus.group.visible).toBe(true);
    expect(probe.stylus.group.quaternion.toArray()).toEqual([0, 0, 0.6, 0.8]);
    probe.setStylusShown(false);
    probe.update(turned);
    expect(probe.stylus.group.visible).toBe(false);
  });
});
