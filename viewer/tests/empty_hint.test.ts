// The address that an empty scene shows is one that clients understand.
import { expect, test } from "vitest";
import { clientAddress } from "../src/empty_hint";

test("the page's own host, with or without TLS", () => {
  expect(clientAddress({ protocol: "http:", host: "127.0.0.1:1997" })).toBe("hl://127.0.0.1:1997");
  expect(clientAddress({ protocol: "https:", host: "lab.example" })).toBe("hls://lab.example");
});
