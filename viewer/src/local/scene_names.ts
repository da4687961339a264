// The built-in scenes by names that can be loaded. Pure.

/** Of the scenes that need a number: of triangles or points, or of samples along a side. */
const kUsual = 10_000, kUsualSide = 81;

/** From "teapot[:N], terrain:N, ..." the scenes, with a usual number where they need one. */
export function pickableScenes(list: string): string[] {
  const usual = (name: string) => `:${name.startsWith("ct:") ? kUsualSide : kUsual}`;
  return list.split(",").map((entry) => entry.trim().replace(/\[[^\]]*\]/g, ""))
    .filter((name) => name !== "").map((name) => name.replace(/:N$/, usual(name)));
}
