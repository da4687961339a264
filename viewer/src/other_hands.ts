// All hands but the one that the page moves: those of the server's other devices, and those of other servers of a
// shared world.

import * as THREE from "three";
import type { Hello, State } from "./gen/hl_pb";
import type { ViewFrame } from "./hand_mapping";
import type { HandChoice } from "./moved_hands";
import { OtherDevices, type DeviceActions } from "./other_devices";
import { RemoteHands } from "./remote_hands";
import { ServerColours } from "./shared_world";
import { SharedWorldView } from "./shared_world_view";

export class OtherHands {
  readonly group = new THREE.Group();
  private readonly devices_: OtherDevices;
  private readonly remote_: RemoteHands;
  private readonly shared_: SharedWorldView;

  constructor(actions: DeviceActions) {
    this.devices_ = new OtherDevices(actions);
    const colours = new ServerColours();
    this.remote_ = new RemoteHands(colours);
    this.shared_ = new SharedWorldView(colours);
    this.group.add(this.devices_.group, this.remote_.group);
  }

  showHello(hello: Hello): void {
    this.devices_.showHello(hello);
  }

  showChoice(choice: HandChoice): void {
    this.devices_.showChoice(choice);
  }

  setStylusShown(shown: boolean): void {
    [this.devices_, this.remote_].forEach((hands) => hands.setStylusShown(shown));
  }

  setDiagonal(diagonal_m: number): void {
    [this.devices_, this.remote_].forEach((hands) => hands.setDiagonal(diagonal_m));
  }

  applyTheme(): void {
    [this.devices_, this.remote_].forEach((hands) => hands.applyTheme());
  }

  showNumbers(state: State): void {
    [this.devices_, this.shared_].forEach((panel) => panel.showNumbers(state));
  }

  /** The server is not heard. */
  lose(): void {
    this.devices_.lose();
  }

  /** Once per drawn frame. */
  showProbes(state: State | undefined, camera: THREE.Camera, view: ViewFrame): void {
    [this.devices_, this.remote_].forEach((hands) => hands.showProbes(state, camera, view));
  }
}
