// What a scene without objects shows: how a program brings some.

import { element, setText } from "./elements";

/** The address of the server that sent this page, as HL clients write it. */
export function clientAddress(page: { readonly protocol: string; readonly host: string }): string {
  return `${page.protocol === "https:" ? "hls" : "hl"}://${page.host}`;
}

export function showEmptyHint(shown: boolean): void {
  setText("client-address", clientAddress(location));
  element("empty").hidden = !shown;
}
