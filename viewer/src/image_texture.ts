// What the eye sees on a surface: a haptic texture as grey, wrapped and filtered as the proxy feels it, or a picture of
// the model's file.

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
  finish(texture, image);
  return texture;
}

/** The picture of a PNG or JPEG file; undefined when the browser cannot read it. */
export async function pictureTexture(image: SurfaceImage): Promise<THREE.Texture | undefined> {
  const kPng = 0x89;
  const type = image.file[0] === kPng ? "image/png" : "image/jpeg";
  const blob = new Blob([image.file as Uint8Array<ArrayBuffer>], { type });
  try {
    // The row of v = 0 first.
    const bitmap = await createImageBitmap(blob, { imageOrientation: "flipY", premultiplyAlpha: "none" });
    const texture = new THREE.Texture(bitmap);
    texture.flipY = false;
    finish(texture, image);
    return texture;
  } catch {
    return undefined;
  }
}

function finish(texture: THREE.Texture, image: SurfaceImage): void {
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = texture.wrapT = image.clamp ? THREE.ClampToEdgeWrapping : THREE.RepeatWrapping;
  texture.magFilter = image.nearest ? THREE.NearestFilter : THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
}
