import { expect, test } from "vitest";
import { Announcer, kAnnounce_ms } from "../src/announcer";

test("says what is touched, when it changes, and not more often than every two seconds", () => {
  const said: string[] = [];
  const announcer = new Announcer((text) => said.push(text));
  announcer.hear("", 0, 0);
  expect(said).toEqual([]);
  announcer.hear("the model", 1.84, 100);
  announcer.hear("the model", 3, 200);
  announcer.hear("", 0, 1000);
  expect(said).toEqual(["touching the model, 1.8 N"]);
  announcer.hear("the model", 1.9, 100 + kAnnounce_ms);
  expect(said.length).toBe(1);
  announcer.hear("object 2", NaN, 101 + kAnnounce_ms);
  announcer.hear("", 0, 102 + 2 * kAnnounce_ms);
  expect(said.slice(1)).toEqual(["touching object 2, 0.0 N", "touching nothing"]);
});
