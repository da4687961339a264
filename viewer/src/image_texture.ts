// A haptic texture as the eye sees it: its values as grey, wrapped and filtered as the proxy feels them.

import * as THREE from "three";
import type { SurfaceImage } from "./gen/hl_pb";

/** The darkest grey: the model must stay readable under its texture. */
const kDarkest = 70;

export function imageTexture(image: SurfaceImage): THREE.DataTexture {
  const pixels = new Uint8Array(4 * image.texels.length);
  image.texels.forEach((texel, i) => {
    const grey = kDarkest + Math.round(((255 - kDarkest) * texel) / 255);
    pixels.set([grey, grey, grey, 255], 4 * i);
  });
  const texture = new THREE.DataTexture(pixels, image.width, image.height, THREE.RGBAFormat);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = texture.wrapT = image.clamp ? THREE.ClampToEdgeWrapping : THREE.RepeatWrapping;
  texture.magFilter = image.nearest ? THREE.NearestFilter : THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}
