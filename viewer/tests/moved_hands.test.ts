import { create, fromBinary } from "@bufbuild/protobuf";
import { beforeEach, describe, expect, it } from "vitest";
import { HelloSchema, StateSchema, ViewerMessageSchema, type Hello, type State, type ViewerMessage } from "../src/gen/hl_pb";
import { isAside, MovedHands } from "../src/moved_hands";
import type { Vec } from "../src/vec";

const kWay: Vec = { x: 0.01, y: 0.02, z: -0.01 };

function helloOf(...simulated: boolean[]): Hello {
  const devices = simulated.map((simulatedHand, i) => ({ name: "a device", label: `device${i}`, simulatedHand }));
  return create(HelloSchema, { device: devices[0]!, devices: devices.length > 1 ? devices : [] });
}

/** Fingers side by side, 0.1 m apart along x. */
function stateOf(devices: number, exploring = -1): State {
  const hand = (i: number) => ({ finger: { x: 0.1 * i, y: 0, z: 0 }, proxy: { x: 0.1 * i, y: 0, z: 0 }, exploring: exploring === i });
  return create(StateSchema, { ...hand(0), others: Array.from({ length: devices - 1 }, (_, i) => hand(i + 1)) });
}

describe("hands that the page moves", () => {
  let sent: ViewerMessage[];
  let state: State | undefined;
  let changes: number;
  let beats: number;
  let hands: MovedHands;
  let now_ms: number;

  beforeEach(() => {
    sent = [];
    state = stateOf(3);
    changes = beats = now_ms = 0;
    hands = new MovedHands({
      send: (message) => sent.push(fromBinary(ViewerMessageSchema, message)),
      here: () => ++beats,
      state: () => state,
      worldPerHand: () => 1,
      changed: () => ++changes,
    });
    hands.showHello(helloOf(true, true, true));
  });

  /** Long after the last one: it is sent immediately. */
  const goal = (position: Vec) => hands.goal(position, (now_ms += 1000));
  const goals = () => sent.filter(({ body }) => body.case === "handGoal").map(({ device, body }) => {
    const { x, y, z } = (body.value as { position: Vec }).position;
    return { device, x: +x.toFixed(6), y: +y.toFixed(6), z: +z.toFixed(6) };
  });
  const kinds = () => sent.map(({ device, body }) => `${body.case} ${device}`);

  it("are the first one until another is chosen, and then that one alone", () => {
    expect(hands.grab()).toEqual({ x: 0, y: 0, z: 0 });
    goal(kWay);
    hands.choose(2);
    expect(hands.grab()).toEqual({ x: 0.2, y: 0, z: 0 });
    goal(kWay);
    expect(goals()).toEqual([{ device: 0, ...kWay }, { device: 2, ...kWay }]);
    expect(hands.now?.finger).toEqual({ x: 0.2, y: 0, z: 0 });
    expect(changes).toBe(2);
  });

  it("are held on by saying it again, as a server lets go of what a silent page holds", () => {
    hands.sayAgain();
    hands.grab();
    goal(kWay);
    hands.sayAgain();
    expect(goals()).toEqual([{ device: 0, ...kWay }, { device: 0, ...kWay }]);
    expect(beats).toBe(0);
    hands.letGo();  // keeps its goal, as there are several
    hands.sayAgain();
    expect(goals().length).toBe(2);
    expect(beats).toBe(1);
    hands.releaseAll();
    hands.sayAgain();
    expect(beats).toBe(1);
  });

  it("are the next simulated one in turn, past those that persons hold", () => {
    hands.showHello(helloOf(false, true, false, true));
    state = stateOf(4);
    const seen = [hands.choice.chosen];
    for (let i = 0; i < 2; ++i) {
      hands.chooseNext();
      seen.push(hands.choice.chosen);
    }
    expect(seen).toEqual([1, 3, 1]);
    hands.choose(2);
    expect(hands.choice).toEqual({ simulated: [1, 3], chosen: 1, together: false });
    expect([0, 1, 2, 3].filter((device) => isAside(hands.choice, device))).toEqual([3]);
    hands.setTogether(true);
    expect(isAside(hands.choice, 3)).toBe(false);
  });

  it("are none where persons hold all devices", () => {
    hands.showHello(helloOf(false, false));
    hands.chooseNext();
    hands.setTogether(true);
    expect(hands.movable).toBe(false);
    expect(hands.grab()).toBeUndefined();
    expect(hands.choice).toEqual({ simulated: [], chosen: 0, together: false });
  });

  it("together go the same way, and keep their offsets", () => {
    hands.choose(1);
    hands.setTogether(true);
    expect(hands.grab()).toEqual({ x: 0.1, y: 0, z: 0 });
    goal({ x: 0.1, y: 0.05, z: 0.02 });
    expect(goals()).toEqual([
      { device: 1, x: 0.1, y: 0.05, z: 0.02 }, { device: 0, x: 0, y: 0.05, z: 0.02 }, { device: 2, x: 0.2, y: 0.05, z: 0.02 },
    ]);
  });

  it("keep the force that they were left with, so that two hold a body between them", () => {
    hands.grab();
    goal({ x: 0.02, y: 0, z: 0 });  // 2 cm into the body that stops the finger
    hands.letGo();
    hands.choose(1);
    hands.grab();
    goal({ x: 0.08, y: 0, z: 0 });
    hands.letGo();
    hands.setTogether(true);
    sent = [];
    expect(hands.grab()).toEqual({ x: 0.08, y: 0, z: 0 });
    goal({ x: 0.08, y: 0.04, z: 0 });
    expect(goals()).toContainEqual({ device: 0, x: 0.02, y: 0.04, z: 0 });
    expect(kinds()).not.toContain("release 0");
  });

  it("start at the finger when it is elsewhere than the hand was left, or explores", () => {
    hands.grab();
    goal({ x: 0, y: 0.3, z: 0 });
    hands.letGo();
    expect(hands.grab()).toEqual({ x: 0, y: 0, z: 0 });
    goal({ x: 0, y: 0.03, z: 0 });
    hands.letGo();
    hands.follow(stateOf(3, 0));
    expect(hands.grab()).toEqual({ x: 0, y: 0, z: 0 });
  });

  it("alone let their force go", () => {
    hands.showHello(helloOf(true));
    hands.grab();
    goal(kWay);
    hands.letGo();
    hands.letGo();
    expect(kinds()).toEqual(["handGoal 0", "release 0"]);
  });

  it("alone come up to the proxy from beneath a surface, and are released there", () => {
    hands.showHello(helloOf(true));
    const pressing = (depth_m: number) => create(StateSchema, {
      finger: { x: 0, y: -depth_m, z: 0 }, proxy: { x: 0, y: 0, z: 0 }, contacts: [{}],
    });
    state = pressing(0.006);
    hands.grab();
    goal({ x: 0, y: -0.05, z: 0 });
    hands.letGo();
    expect(goals().at(-1)).toEqual({ device: 0, x: 0, y: 0, z: 0 });
    hands.frame(now_ms);
    expect(kinds()).toEqual(["handGoal 0", "handGoal 0"]);
    state = pressing(0.00004);
    hands.frame(now_ms);
    hands.frame(now_ms);
    expect(kinds()).toEqual(["handGoal 0", "handGoal 0", "release 0"]);
  });

  it("alone are released at once where nothing more can be sent", () => {
    hands.showHello(helloOf(true));
    state = create(StateSchema, { finger: { y: -0.006 }, proxy: {}, contacts: [{}] });
    hands.grab();
    hands.letGoAtOnce();
    expect(kinds()).toEqual(["handGoal 0", "release 0"]);
    hands.letGoAtOnce();
    hands.frame(now_ms + 501);
    expect(kinds()).toEqual(["handGoal 0", "release 0"]);
  });

  it("alone are released soon where they do not come up", () => {
    hands.showHello(helloOf(true));
    state = create(StateSchema, { finger: { y: -0.006 }, proxy: {}, contacts: [{}] });
    hands.grab();
    hands.letGo();
    hands.frame(now_ms);
    hands.frame(now_ms + 500);
    expect(kinds()).toEqual(["handGoal 0"]);
    hands.frame(now_ms + 501);
    expect(kinds()).toEqual(["handGoal 0", "release 0"]);
  });

  it("alone are not released once they are grabbed again, and not led up while they explore", () => {
    hands.showHello(helloOf(true));
    state = create(StateSchema, { finger: { y: -0.006 }, proxy: {}, contacts: [{}] });
    hands.grab();
    hands.letGo();
    hands.grab();
    state = stateOf(1);
    hands.frame(now_ms);
    expect(kinds()).toEqual(["handGoal 0"]);
    state = create(StateSchema, { finger: { y: -0.006 }, proxy: {}, contacts: [{}], exploring: true });
    hands.letGo();
    expect(kinds()).toEqual(["handGoal 0", "release 0"]);
  });

  it("let their force go when what they held has gone", () => {
    hands.setTogether(true);
    hands.grab();
    goal(kWay);
    sent = [];
    hands.releaseAll();
    hands.releaseAll();
    expect(kinds().sort()).toEqual(["release 0", "release 1", "release 2"]);
  });

  it("send no more goals than a server takes of a page, and the last one in the end", () => {
    hands.setTogether(true);
    hands.grab();
    for (let frame = 0; frame < 240; ++frame) hands.goal({ x: 0, y: frame, z: 0 }, (now_ms += 1000 / 240));
    expect(sent.length).toBeGreaterThan(200);
    expect(sent.length).toBeLessThan(400);
    hands.frame((now_ms += 1000));
    expect(goals().at(-1)).toMatchObject({ device: 2, y: 239 });
    hands.goal({ x: 0, y: 500, z: 0 }, now_ms);
    hands.letGo();
    expect(goals().at(-1)).toMatchObject({ device: 2, y: 500 });
  });

  it("fall back to the first when the chosen one's row goes", () => {
    hands.choose(2);
    hands.setTogether(true);
    hands.follow(state = stateOf(2));
    expect(hands.choice).toEqual({ simulated: [0, 1], chosen: 0, together: true });
    hands.follow(state = stateOf(1));
    expect(hands.choice).toEqual({ simulated: [0], chosen: 0, together: false });
  });

  it("stay chosen while the server goes and comes back, if it has them still", () => {
    hands.choose(1);
    hands.showHello(helloOf(true, true, true));
    expect(hands.choice.chosen).toBe(1);
    hands.showHello(helloOf(true));
    expect(hands.choice.chosen).toBe(0);
  });

  it("get buttons, turns and the wish to explore; the grip is of all, the rest of the first device", () => {
    hands.choose(1);
    hands.press(2);
    hands.turn(undefined, 0.5);
    hands.sendSettings({ explore: false });
    hands.sendSettings({ handFirm: true });
    hands.sendSettings({ stiffnessNM: 500 });
    expect(kinds()).toEqual([
      "press 1", "handTurn 1", "settings 1", "settings 0", "settings 1", "settings 2", "settings 0",
    ]);
    sent = [];
    hands.setTogether(true);
    hands.sendSettings({ explore: true });
    expect(kinds()).toEqual(["settings 0", "settings 1", "settings 2"]);
  });

  it("take the buttons that are down along", () => {
    hands.press(1);
    hands.choose(1);
    expect(sent.map(({ device, body }) => [device, (body.value as { buttons: number }).buttons])).toEqual(
      [[0, 1], [0, 0], [1, 1]],
    );
  });

  it("are not grabbed where nothing is known", () => {
    state = undefined;
    expect(hands.grab()).toBeUndefined();
    goal(kWay);
    hands.letGo();
    expect(sent).toEqual([]);
  });
});
