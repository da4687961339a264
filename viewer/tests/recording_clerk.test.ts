// What the page asks of the server's recorder, and when it stops asking.
import { create, type MessageInitShape } from "@bufbuild/protobuf";
import { describe, expect, test } from "vitest";
import { PageRecording_Phase as Phase, PageRecordingSchema } from "../src/gen/hl_pb";
import { RecordingClerk } from "../src/recording_clerk";

const kOwner = 5;
const said = (values: MessageInitShape<typeof PageRecordingSchema> = {}) =>
  create(PageRecordingSchema, { maxTimeS: 600, maxBytes: 200_000_000n, ...values });

function begun() {
  const sent: [boolean, number][] = [];
  const clerk = new RecordingClerk((on, owner) => sent.push([on, owner]));
  clerk.press(kOwner);
  return { clerk, sent };
}

describe("a recording", () => {
  test("is asked for again while it runs, ended, and then to be fetched once", () => {
    const { clerk, sent } = begun();
    expect(clerk.hear(said(), 0)).toMatchObject({ own: true, ofAnother: false });
    const running = said({ phase: Phase.RUNNING, owner: kOwner, timeS: 12, bytes: 1_500_000n });
    const news = clerk.hear(running, 1000);
    expect(news).toMatchObject({ own: true, ofAnother: false });
    expect(news.line).toMatch(/^Recording: 12\ss of 600\ss, 1\.5\d*\sMB$/);
    clerk.hear(running, 1200);
    clerk.hear(running, 2100);
    expect(sent).toEqual(Array(4).fill([true, kOwner]));
    clerk.press(99);
    expect(sent.at(-1)).toEqual([false, kOwner]);
    const ready = said({ phase: Phase.READY, owner: kOwner, text: "stopped" });
    expect(clerk.hear(ready, 3000)).toMatchObject({ own: false, ready: kOwner, end: "stopped", line: "" });
    expect(clerk.hear(ready, 9000).ready).toBeUndefined();
    expect(sent).toHaveLength(5);
  });

  test("that the server refuses is reported once", () => {
    const { clerk } = begun();
    const refused = said({ owner: kOwner, text: "an object that is driven cannot be recorded" });
    expect(clerk.hear(refused, 0)).toMatchObject({
      own: false, refused: "There is no recording: an object that is driven cannot be recorded.",
    });
    expect(clerk.hear(refused, 9000).refused).toBeUndefined();
  });

  test("of another page is reported, and cannot be ended by this one", () => {
    const sent: unknown[] = [];
    const clerk = new RecordingClerk((...words) => sent.push(words));
    const news = clerk.hear(said({ phase: Phase.RUNNING, owner: 8, timeS: 3 }), 0);
    expect(news).toMatchObject({ own: false, ofAnother: true, limits: expect.stringMatching(/10 minutes or 200\sMB/) });
    expect(news.line).toMatch(/^Another page records: 3/);
    expect(sent).toEqual([]);
  });

  test("that another page was faster with, or that a new server does not know, is given up", () => {
    expect(begun().clerk.hear(said({ phase: Phase.RUNNING, owner: 8 }), 0).refused).toMatch(/another page records/);
    const { clerk } = begun();
    clerk.hear(said({ phase: Phase.RUNNING, owner: kOwner }), 0);
    expect(clerk.hear(said(), 1).refused).toMatch(/given it up/);
  });
});
