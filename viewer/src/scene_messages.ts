// What the server sends of the scene, as values the page can trust: meshes with every index proven to be in range,
// layouts and moves with a whole pose for each object.

import { checkPlaces, type FeltPlaces } from "./felt_places";
import type { PlacedJoint, PlacedMesh, SceneLayout, SceneMesh, State, SurfaceImage } from "./gen/hl_pb";
import type { Vec } from "./vec";
import { checkVolumes, type Volume } from "./volumes";
import { floats, indices, knownVec, ProtocolError, shorts } from "./wire_values";

/** Numbers of a pose: 3 x 4, row by row, object to world. */
export const kPoseNumbers = 12;

export interface Bounds {
  readonly min: Vec;
  readonly max: Vec;
}

/** A texture or a picture to show, and the runs of triangles that show it. */
export interface SurfaceLook {
  readonly image: SurfaceImage;
  readonly runs: readonly { readonly first: number; readonly count: number }[];
}

/** One kind of object, in its own frame. */
export interface Mesh {
  readonly number: number;
  readonly positions: Float32Array;
  readonly normals: Float32Array | undefined;
  readonly triangles: Uint32Array;
  readonly segments: Uint32Array;
  readonly points: Uint32Array;
  readonly texcoords: Float32Array | undefined;
  readonly looks: readonly SurfaceLook[];
  /** Red, green and blue of each vertex, 0..255 (sRGB); absent: it is drawn as others are. */
  readonly colours?: Uint8Array | undefined;
  /** Of a cloud: its points; the triangles are discs at some or all of them. Absent: it is no cloud. */
  readonly cloudPoints?: number | undefined;
  /** Material number of each triangle; empty: all have 0. */
  readonly triangleMaterials: Uint16Array;
  readonly bounds: Bounds | undefined;
}

/** Which meshes are where. */
export interface Layout {
  readonly number: number;
  readonly name: string;
  readonly bounds: Bounds | undefined;
  readonly proxyRadius_m: number;
  readonly worldPerDevice: number;
  readonly placed: readonly PlacedMesh[];
  readonly poses: Float32Array;
  /** Absent: none of them is a body, or that is not known. */
  readonly mechanics?: Mechanics | undefined;
  /** Absent: not known. */
  readonly felt?: FeltPlaces | undefined;
  /** Those whose iso value can be changed; absent: none can. */
  readonly volumes?: readonly Volume[];
}

/** What acts on the bodies of a layout. */
export interface Mechanics {
  readonly gravity_m_s2: Vec;
  readonly joints: readonly PlacedJoint[];
}

/** Those of a layout's objects that are elsewhere now. */
export interface Moves {
  readonly layout: number;
  readonly indices: readonly number[];
  readonly poses: Float32Array;
}

export function checkMesh(mesh: SceneMesh): Mesh {
  const positions = floats(mesh.positions, "positions");
  if (positions.length % 3 !== 0) {
    throw new ProtocolError("the scene's positions are not whole vertices");
  }
  const vertices = positions.length / 3;
  const normals = mesh.normals.length === 0 ? undefined : floats(mesh.normals, "normals");
  if (normals !== undefined && normals.length !== positions.length) {
    throw new ProtocolError("the scene has not one normal per vertex");
  }
  return {
    number: mesh.number,
    positions,
    normals,
    triangles: indices(mesh.triangles, 3, vertices, "triangles"),
    segments: indices(mesh.segments, 2, vertices, "segments"),
    points: indices(mesh.points, 1, vertices, "points"),
    ...checkLooks(mesh, vertices),
    colours: checkColours(mesh, vertices),
    cloudPoints: mesh.cloudPoints > 0n ? Number(mesh.cloudPoints) : undefined,
    triangleMaterials: checkMaterials(mesh),
    bounds: boundsOf(mesh),
  };
}

export function checkLayout(layout: SceneLayout): Layout {
  const { number, name, placed, worldPerDevice, proxyRadius } = layout;
  return {
    number, name, placed, worldPerDevice,
    bounds: boundsOf(layout),
    proxyRadius_m: proxyRadius > 0 && Number.isFinite(proxyRadius) ? proxyRadius : 0,
    poses: checkPoses(layout.poses, placed.length),
    mechanics: checkMechanics(layout),
    felt: checkPlaces(layout),
    volumes: checkVolumes(layout),
  };
}

function checkMechanics({ placed, joints, gravityMS2 }: SceneLayout): Mechanics | undefined {
  const gravity_m_s2 = knownVec(gravityMS2);
  placed.filter(({ body }) => body !== undefined).forEach(({ start }) => checkPoses(start, 1));
  const isBody = (index: number) => placed[index]?.body !== undefined;
  if (joints.some(({ joint, bodyA, bodyB }) => !joint || !isBody(bodyA) || (bodyB !== undefined && !isBody(bodyB)))) {
    throw new ProtocolError("a joint of the scene has no body");
  }
  return gravity_m_s2 === undefined ? undefined : { gravity_m_s2, joints };
}

export function checkMoves(state: State): Moves {
  return { layout: state.layout, indices: state.moved, poses: checkPoses(state.movedPoses, state.moved.length) };
}

function checkPoses(bytes: Uint8Array, count: number): Float32Array {
  const poses = floats(bytes, "poses");
  if (poses.length !== kPoseNumbers * count) {
    throw new ProtocolError("the scene has not one pose per object");
  }
  return poses;
}

function boundsOf(message: SceneMesh | SceneLayout): Bounds | undefined {
  const min = knownVec(message.boundsMin);
  const max = knownVec(message.boundsMax);
  return min === undefined || max === undefined ? undefined : { min, max };
}

function checkMaterials(mesh: SceneMesh): Uint16Array {
  const numbers = shorts(mesh.triangleMaterials, "material numbers");
  if (numbers.length !== 0 && numbers.length !== mesh.triangles.length / 12) {
    throw new ProtocolError("the scene has not one material per triangle");
  }
  return numbers;
}

function checkColours({ colours }: SceneMesh, vertices: number): Uint8Array | undefined {
  if (colours.length !== 0 && colours.length !== 3 * vertices) {
    throw new ProtocolError("the scene has not one colour per vertex");
  }
  return colours.length === 0 ? undefined : colours;
}

function checkLooks(mesh: SceneMesh, vertices: number): { texcoords: Float32Array | undefined; looks: SurfaceLook[] } {
  if (mesh.parts.length === 0) {
    return { texcoords: undefined, looks: [] };
  }
  const texcoords = floats(mesh.texcoords, "texture coordinates");
  if (texcoords.length !== 2 * vertices) {
    throw new ProtocolError("the scene has not one texture coordinate per vertex");
  }
  const looks = mesh.images.map((image) => {
    const texels = image.width * image.height;
    if (image.file.length === 0 && (texels < 1 || image.texels.length !== texels)) {
      throw new ProtocolError("a texture of the scene is cut short");
    }
    return { image, runs: [] as { first: number; count: number }[] };
  });
  const triangles = mesh.triangles.length / 12;
  for (const { firstTriangle, triangles: count, image } of mesh.parts) {
    const look = looks[image];
    if (look === undefined || firstTriangle + count > triangles) {
      throw new ProtocolError("a part of the scene has a texture or a triangle that does not exist");
    }
    look.runs.push({ first: firstTriangle, count });
  }
  return { texcoords, looks };
}
