// The devices of a server that has several: a row for each in the panel, with its state, its force, a button that arms it
// again, and one that makes a simulated hand the one that the page moves; and in the scene the probes of all but the first.

import { create } from "@bufbuild/protobuf";
import * as THREE from "three";
import { deviceRows, type DeviceRow } from "./device_rows";
import { element } from "./elements";
import { SafetyState, StateSchema, type Hello, type State } from "./gen/hl_pb";
import { depthOf, metresPerPixel, type ViewFrame } from "./hand_mapping";
import { isAside, type HandChoice } from "./moved_hands";
import { ProbeView } from "./probe_view";
import { kUnknown } from "./units";

interface RowElements {
  readonly root: HTMLElement;
  readonly name: HTMLElement;
  readonly force: HTMLElement;
  readonly move: HTMLButtonElement;
  readonly rearm: HTMLButtonElement;
  readonly fault: HTMLElement;
}

/** What the user asks of devices, by their numbers. */
export interface DeviceActions {
  rearm(device: number): void;
  /** The page is to move this one's hand. */
  choose(device: number): void;
  chooseNext(): void;
  toggleTogether(): void;
}

export class OtherDevices {
  readonly group = new THREE.Group();
  private readonly section_ = element("devices");
  private readonly list_ = element("device-list");
  private rows_: RowElements[] = [];
  private probes_: ProbeView[] = [];
  private hello_: Hello | undefined;
  private diagonal_m_ = 1;

  constructor(private readonly actions_: DeviceActions) {
    element("next-hand").addEventListener("click", () => actions_.chooseNext());
    element("together").addEventListener("click", () => actions_.toggleTogether());
  }

  showHello(hello: Hello): void {
    this.hello_ = hello;
    this.group.clear();
    this.probes_ = hello.devices.slice(1).map((device) => {
      const probe = new ProbeView();
      probe.setForceMax(device.forceMaxN);
      probe.setDiagonal(this.diagonal_m_);
      probe.drop.setShown(false);
      probe.stylus.setGripper(device.gripperMaxRad);
      probe.applyTheme();
      this.group.add(probe.group);
      return probe;
    });
    this.list_.replaceChildren();
    this.rows_ = hello.devices.map((_, number) => this.makeRow(number));
    this.section_.hidden = true;
  }

  showChoice(choice: HandChoice): void {
    const { simulated, chosen, together } = choice;
    this.probes_.forEach((probe, i) => probe.setAside(isAside(choice, i + 1)));
    this.rows_.forEach(({ move }, device) => {
      move.hidden = simulated.length < 2 || !simulated.includes(device);
      move.setAttribute("aria-pressed", String(device === chosen));
    });
    element("next-hand").hidden = element("together").hidden = simulated.length < 2;
    element("together").setAttribute("aria-pressed", String(together));
  }

  setStylusShown(shown: boolean): void {
    this.probes_.forEach((probe) => probe.stylus.setShown(shown));
  }

  setDiagonal(diagonal_m: number): void {
    this.diagonal_m_ = diagonal_m;
    this.probes_.forEach((probe) => probe.setDiagonal(diagonal_m));
  }

  applyTheme(): void {
    this.probes_.forEach((probe) => probe.applyTheme());
  }

  showNumbers(state: State): void {
    const rows = deviceRows(this.hello_, state);
    this.section_.hidden = rows.length === 0;
    this.rows_.forEach((row, number) => (row.root.hidden = number >= rows.length));
    rows.forEach((row, number) => this.fill(this.rows_[number]!, row));
  }

  /** The server is not heard: what it sent last may no longer hold. */
  lose(): void {
    this.rows_.forEach(({ force }) => (force.textContent = kUnknown));
  }

  /** Once per drawn frame. */
  showProbes(state: State | undefined, camera: THREE.Camera, view: ViewFrame): void {
    this.probes_.forEach((probe, i) => {
      const other = state?.others[i];
      if (other?.finger === undefined || other.proxy === undefined || other.forceN === undefined) {
        probe.update(undefined);
        return;
      }
      probe.setRadius(other.proxyRadius);
      const { finger, proxy, forceN, stylus } = other;
      probe.update(create(StateSchema, { finger, proxy, forceN, ...(stylus && { stylus }) }));
      probe.face(camera, metresPerPixel(view, depthOf(view, proxy)));
    });
  }

  private fill(row: RowElements, values: DeviceRow): void {
    row.root.dataset.safety = SafetyState[values.safety] ?? "OFF";
    row.name.textContent = values.label;
    row.name.title = values.model;
    row.move.setAttribute("aria-label", `Move this hand: ${values.label}`);
    row.force.textContent = values.force;
    row.rearm.hidden = row.fault.hidden = values.fault === "";
    row.fault.textContent = values.fault;
  }

  private makeRow(number: number): RowElements {
    const make = <K extends keyof HTMLElementTagNameMap>(tag: K, name: string): HTMLElementTagNameMap[K] => {
      const made = document.createElement(tag);
      made.className = name;
      return made;
    };
    const row = {
      root: make("li", "safety device"), name: make("span", "safety-state"), force: make("output", "device-force"),
      move: make("button", "small move"), rearm: make("button", ""), fault: make("p", ""),
    };
    row.move.type = row.rearm.type = "button";
    row.move.textContent = "Move";
    row.move.title = "Move this hand with mouse, keys and gamepad";
    row.move.addEventListener("click", () => this.actions_.choose(number));
    row.rearm.textContent = "Re-arm";
    row.rearm.addEventListener("click", () => this.actions_.rearm(number));
    row.root.append(row.name, row.force, row.move, row.rearm, row.fault);
    this.list_.append(row.root);
    return row;
  }
}
