// The tooltip that says why ticks ended.
import { create } from "@bufbuild/protobuf";
import { expect, test } from "vitest";
import { TicksEndedSchema } from "../src/gen/hl_pb";
import { describeEndings } from "../src/ticks_ended";
import { kThinSpace } from "../src/units";

const plain = (text: string) => text.replaceAll(kThinSpace, " ");

test("endings are listed by their names, in the order of the protocol", () => {
  const ticks = create(TicksEndedSchema, { outOfWork: 1n, reached: 1234n, noEnergy: 2n });
  expect(plain(describeEndings(ticks))).toBe("Ticks by why they ended: reached 1 234, no energy 2, out of work 1");
});

test("each ending of the protocol is listed", () => {
  const counts = TicksEndedSchema.fields.map(({ localName }, i) => [localName, BigInt(i + 1)] as const);
  const ticks = create(TicksEndedSchema, Object.fromEntries(counts));
  expect(describeEndings(ticks)).toMatch(/reached 1, .*out of work 9, unplaced 10, invalid 11$/);
});

test("nothing is listed where no tick has ended, and for a server that does not count", () => {
  expect(describeEndings(create(TicksEndedSchema))).toBe("");
  expect(describeEndings(undefined)).toBe("");
});
