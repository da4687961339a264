// The built-in scenes by names that can be loaded. Pure.

/** Of the scenes that need a number of triangles. */
const kUsual = 10_000;

/** From "teapot[:N], terrain:N, ..." the scenes, with a usual number where they need one. */
export function pickableScenes(list: string): string[] {
  return list.split(",").map((entry) => entry.trim().replace(/\[[^\]]*\]/g, "").replace(/:N$/, `:${kUsual}`))
    .filter((name) => name !== "");
}
