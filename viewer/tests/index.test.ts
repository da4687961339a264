// What the page's own text says.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";

test("no two readings that are shown together have the same name", () => {
  const html = readFileSync(new URL("../index.html", import.meta.url), "utf8");
  const readouts = html.slice(html.indexOf('<aside id="readouts"'), html.indexOf("</aside>"));
  const [live, recorded] = readouts.split('<div class="recorded-only">') as [string, string];
  for (const part of [live, recorded]) {
    const names = [...part.matchAll(/<dt[^>]*>([^<]*)<\/dt>/g)].map(([, name]) => name!);
    expect(names.length).toBeGreaterThan(1);
    expect(names).toEqual([...new Set(names)]);
  }
});
