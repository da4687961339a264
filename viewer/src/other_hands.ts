// All hands but the one that the page moves: those of the server's other devices, and those of other servers of a
// shared world.

import * as THREE from "three";
import type { Hello, State } from "./gen/hl_pb";
import { OtherDevices } from "./other_devices";
import { SharedWorldView } from "./shared_world_view";

export class OtherHands {
  readonly group = new THREE.Group();
  private readonly devices_: OtherDevices;
  private readonly shared_ = new SharedWorldView();

  constructor(rearm: (device: number) => void) {
    this.devices_ = new OtherDevices(rearm);
    this.group.add(this.devices_.group, this.shared_.group);
  }

  showHello(hello: Hello): void {
    this.devices_.showHello(hello);
  }

  setStylusShown(shown: boolean): void {
    [this.devices_, this.shared_].forEach((hands) => hands.setStylusShown(shown));
  }

  setDiagonal(diagonal_m: number): void {
    [this.devices_, this.shared_].forEach((hands) => hands.setDiagonal(diagonal_m));
  }

  applyTheme(): void {
    [this.devices_, this.shared_].forEach((hands) => hands.applyTheme());
  }

  showNumbers(state: State): void {
    [this.devices_, this.shared_].forEach((hands) => hands.showNumbers(state));
  }

  /** Once per drawn frame. */
  showProbes(state: State | undefined, camera: THREE.Camera, metresPerPixel: number): void {
    [this.devices_, this.shared_].forEach((hands) => hands.showProbes(state, camera, metresPerPixel));
  }
}
