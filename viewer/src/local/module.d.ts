// Made by scripts/build --web; vite.web.config.ts says where it is.
declare module "hl-web-module" {
  const make: (options: { wasmBinary: ArrayBuffer }) => Promise<import("./engine").Module>;
  export default make;
}
declare module "hl-web-binary?url" {
  const url: string;
  export default url;
}
