// Materials of the marks that are drawn over the model.

import * as THREE from "three";

/** A material that is seen through the model: position matters more than what is in front of it. */
export function overlay<M extends THREE.Material>(type: new () => M, opacity: number, depthTest = false): M {
  const material = new type();
  material.transparent = true;
  material.opacity = opacity;
  material.depthTest = depthTest;
  material.depthWrite = false;
  material.side = THREE.DoubleSide;
  return material;
}
