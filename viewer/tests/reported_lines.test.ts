// Which reported lines stay.
import { expect, test } from "vitest";
import { lifeOf, stayingConnected, stayingWith, type ReportedLine } from "../src/reported_lines";

const good = (text: string, about: string): ReportedLine => ({ text, bad: false, about });
const bad = (text: string, about: string): ReportedLine => ({ text, bad: true, about });
const ofServer = (text: string): ReportedLine => ({ text, bad: false });
const after = (...lines: ReportedLine[]) =>
  lines.reduce<ReportedLine[]>((shown, next) => [...stayingWith(shown, next), next], []).map(({ text }) => text);

test("what goes well takes the place of what was reported of the same thing, good or bad", () => {
  expect(after(good("a opened", "file"), good("b opened", "file"))).toEqual(["b opened"]);
  expect(after(bad("a is broken", "file"), bad("b is broken", "file"), good("c opened", "file"))).toEqual(["c opened"]);
  expect(after(bad("no recording", "recording"), good("c opened", "file"))).toEqual(["no recording", "c opened"]);
});

test("errors stay beside each other, and the same one is reported once", () => {
  expect(after(bad("a is broken", "file"), bad("b is broken", "file"))).toEqual(["a is broken", "b is broken"]);
  expect(after(bad("a is broken", "file"), bad("b", "file"), bad("a is broken", "file"))).toEqual(["b", "a is broken"]);
  expect(after(good("a opened", "file"), bad("b is broken", "file"))).toEqual(["b is broken"]);
});

test("there are four at most, and those of the server are about nothing", () => {
  expect(after(...["1", "2", "3", "4", "5"].map(ofServer))).toEqual(["2", "3", "4", "5"]);
});

test("only what went well goes by itself, and a long line later", () => {
  expect(lifeOf(bad("x", "file"))).toBeUndefined();
  expect(lifeOf(ofServer("x"))).toBeUndefined();
  expect(lifeOf(good("a long line", "file"))).toBeGreaterThan(lifeOf(good("short", "file"))!);
  expect(lifeOf(good("", "file"))).toBeGreaterThanOrEqual(5000);
});

test("what is reported of a broken connection goes when the server is heard again, and nothing else does", () => {
  const lines = [bad("a is broken", "file"), { ...bad("b could not be sent", "file"), broke: true }, ofServer("hello")];
  expect(stayingConnected(lines).map(({ text }) => text)).toEqual(["a is broken", "hello"]);
});
