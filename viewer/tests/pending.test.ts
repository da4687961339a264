// Who moves a control: the user immediately, the server when it has heard of it, another page when the user is done.
import { expect, test } from "vitest";
import { kGiveUp_ms, kUnderway_ms, Pending } from "../src/pending";

test("without a change of the user's, the server says what is shown", () => {
  expect(new Pending<number>().resolve("friction", 0.3, 0)).toBe(0.3);
});

test("states already on their way do not turn a control back; after the echo the server decides again", () => {
  const pending = new Pending<number>();
  pending.set("friction", 0.8, 0);
  expect(pending.resolve("friction", 0.3, 100)).toBe(0.8);
  expect(pending.resolve("friction", 0.8, 200)).toBe(0.8);
  expect(pending.resolve("friction", 0.3, 300)).toBe(0.8);
  expect(pending.resolve("friction", 0.5, kUnderway_ms + 1)).toBe(0.5);
  expect(pending.resolve("friction", 0.3, kUnderway_ms + 2)).toBe(0.3);
});

test("a slow server is waited for, one that refuses wins in the end", () => {
  const pending = new Pending<boolean>();
  pending.set("explore", true, 0);
  expect(pending.resolve<boolean>("explore", false, kUnderway_ms + 1)).toBe(true);
  expect(pending.resolve<boolean>("explore", false, kGiveUp_ms + 1)).toBe(false);
});

test("a control under the pointer never moves by itself", () => {
  const pending = new Pending<number>();
  pending.hold("friction", 0.3, 0);
  expect(pending.resolve("friction", 0.9, 10 * kGiveUp_ms)).toBe(0.3);
  pending.set("friction", 0.4, 0);
  expect(pending.resolve("friction", 0.9, 10 * kGiveUp_ms)).toBe(0.4);
  pending.letGo(10 * kGiveUp_ms);
  expect(pending.resolve("friction", 0.9, 10 * kGiveUp_ms + 100)).toBe(0.4);
  expect(pending.resolve("friction", 0.9, 11 * kGiveUp_ms + 1)).toBe(0.9);
});

test("a press that changed nothing leaves no trace, and other controls are free", () => {
  const pending = new Pending<number>();
  pending.hold("friction", 0.3, 0);
  expect(pending.resolve("viscosity", 7, 1)).toBe(7);
  pending.letGo(1);
  expect(pending.resolve("friction", 0.9, 2)).toBe(0.9);
});

test("pressing a control again keeps what was just set", () => {
  const pending = new Pending<number>();
  pending.set("friction", 0.8, 0);
  pending.hold("friction", 0.8, 10);
  pending.letGo(20);
  expect(pending.resolve("friction", 0.3, 30)).toBe(0.8);
});

test("not set is a choice too", () => {
  const pending = new Pending<number | undefined>();
  pending.set("friction", undefined, 0);
  expect(pending.resolve<number | undefined>("friction", 0.3, 10)).toBeUndefined();
});

test("a control that is about something else has nothing pending, the others have", () => {
  const pending = new Pending<boolean>();
  pending.set("explore", true, 0);
  pending.set("grip", true, 0);
  pending.forget("explore");
  expect(pending.resolve("explore", false, 1)).toBe(false);
  expect(pending.resolve("grip", false, 1)).toBe(true);
});

test("another server starts with nothing pending", () => {
  const pending = new Pending<number>();
  pending.set("friction", 0.8, 0);
  pending.clear();
  expect(pending.resolve("friction", 0.1, 1)).toBe(0.1);
});

test("a server that takes long is waited for as long as is said, and may round", () => {
  const pending = new Pending<number>({ giveUp_ms: 60_000, same: (a, b) => Math.fround(a) === Math.fround(b) });
  pending.set("skin", -200.1, 0);
  expect(pending.resolve("skin", -400, 10 * kGiveUp_ms)).toBe(-200.1); // what was set on the way to it
  const said = Math.fround(-200.1);
  expect(pending.resolve("skin", said, 20_000)).toBe(said);
  expect(pending.resolve("skin", 7, 20_001)).toBe(7);
  pending.set("skin", -300, 30_000);
  expect(pending.resolve("skin", 7, 90_000)).toBe(-300);
  expect(pending.resolve("skin", 7, 90_001)).toBe(7);
});
