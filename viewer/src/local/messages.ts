// The messages of a server, made from the engine's numbers in the order of web/hl_web.h.

import { kProtocolVersion } from "../protocol";
import { encode } from "./encode";
import { Numbers, type Module } from "./engine";
import type { SentScene } from "./sent_scene";
import type { EngineQuantity } from "./quantities";

const kContacts = 3;

/** What a page gets first. */
export function helloMessage(
  module: Module, name: string, quantities: readonly EngineQuantity[],
): Uint8Array<ArrayBuffer> {
  const n = new Numbers(module, module._hlWebScene());
  const [forceMaxN, stiffnessNM, stiffnessMaxNM, dampingNsM, rate] = [n.next(), n.next(), n.next(), n.next(), n.next()];
  const device = {
    name: "simulated device in this browser", forceMaxN, stiffnessNM, stiffnessMaxNM, dampingNsM, servoRateHz: rate,
    proxyRateHz: rate, simulatedHand: true, hasWrist: true,
  };
  return encode({ case: "hello", value: {
    protocolVersion: kProtocolVersion, serverVersion: "browser", sceneName: name, device,
    quantities: quantities.filter(({ usual }) => usual > 0) } });
}

export interface Sample { timeS: number; forceN: number; penetrationM: number; tickUs: number }

/** The rate is of the real clock. */
export function stateMessage(
  module: Module, samples: readonly Sample[], rateHz: number, surfaces: object, scene: SentScene,
): Uint8Array<ArrayBuffer> {
  const n = new Numbers(module, module._hlWebState());
  const value = {
    timeS: n.next(), finger: n.vec(), proxy: n.vec(), forceN: n.vec(), safety: n.next(), fault: "",
  };
  const [fault, , slipping, exploring, firm, buttons, stiffnessNM] = n.list(7) as [
    number, number, number, number, number, number, number];
  const [limitNM, alarms, vibrationJ] = [n.next(), BigInt(n.next()), n.next()];
  const ledger = {
    tankJ: n.next(), injectedJ: n.next(), dissipatedJ: n.next(), shadingJ: n.next(), stiffnessJ: n.next(),
    textureJ: n.next(), movingJ: n.next(), lateJ: n.next(),
  };
  const big = () => BigInt(n.next());
  const ticksEnded = {
    reached: big(), stationary: big(), settled: big(), stalled: big(), postponed: big(), noEnergy: big(),
    crowded: big(), capped: big(), outOfWork: big(), unplaced: big(), invalid: big(),
  };
  const [steps, count] = [big(), n.next()];
  const contacts = Array.from({ length: kContacts }, () => ({
    point: n.vec(), normal: n.vec(), multiplierM: n.next(), staticFriction: n.next(), stiffness: n.next(),
  })).slice(0, count);
  const touched = n.list(kContacts).slice(0, count).filter((object) => object >= 0);
  const snap = n.next();
  const rotation = { x: n.next(), y: n.next(), z: n.next(), w: n.next() };
  const bodies = bodiesOf(n);
  if (fault !== 0) value.fault = module.UTF8ToString(module._hlWebFault());
  return encode({ case: "state", value: {
    ...value, contacts, slipping: slipping !== 0, exploring: exploring !== 0, handFirm: firm !== 0, buttons, stiffnessNM,
    vibration: { limitNM, alarms, dissipatedJ: vibrationJ }, ledger, ticksEnded, iterationCaps: ticksEnded.capped,
    unplacedTicks: ticksEnded.unplaced, servo: { rateHz, steps }, proxyLoop: { rateHz, steps },
    samples: [...samples], surfaces, touched: [...new Set(touched)], ...(snap >= 0 ? { snap } : {}),
    stylus: { rotation }, ...(bodies.count > 0n ? { bodies } : {}), layout: scene.layout, ...scene.moves(module),
  } });
}

function bodiesOf(n: Numbers) {
  const big = () => BigInt(n.next());
  return {
    count: big(), awake: big(), kineticJ: n.next(), gravityJ: n.next(), springJ: n.next(), byHandJ: n.next(),
    contactJ: n.next(), frictionJ: n.next(), jointsJ: n.next(), solverJ: n.next(), lostS: n.next(), returned: big(),
  };
}
