// What opens a file, and the lines that the user reads on the way.
import { describe, expect, test } from "vitest";
import { BrokenConnection, FileDrop, kAnyEnding, openerOf, shownName, unopened, type FileOpener } from "../src/file_drop";

function opener(what: string, endings: string[], open: FileOpener["open"] = async () => `${what} open`): FileOpener {
  return { what, endings, refusal: () => undefined, open };
}

class Lines {
  readonly reported: string[] = [];
  readonly stood: string[] = [];
  standing: string | undefined;

  stand(_cause: string, text: string | undefined): void {
    this.standing = text;
    if (text !== undefined) this.stood.push(text);
  }

  report(text: string, bad: boolean, _about?: string, broke = false): void {
    this.reported.push(`${broke ? "broke" : bad ? "bad" : "good"}: ${text}`);
  }

  settle(about: string): void {
    this.reported.push(`settled: ${about}`);
  }
}

const fileOf = (name: string) => new File(["x"], name);

describe("the table", () => {
  const models = opener("models", [kAnyEnding]);
  const recordings = opener("recordings", [".hlr"]);
  const scenes = opener("scenes", [".hl.json"]);
  const table = [models, recordings, scenes];

  test("finds the opener by the ending, in either case; the longest ending counts", () => {
    expect(openerOf(table, "a.HLR")).toBe(recordings);
    expect(openerOf(table, "a.hl.json")).toBe(scenes);
    expect(openerOf(table, "a.json")).toBe(models);
    expect(openerOf(table, "hlr")).toBe(models);
    expect(openerOf([recordings], "a.obj")).toBeUndefined();
  });

  test("says what can be opened", () => {
    expect(unopened([recordings, scenes], "a.obj")).toBe(
      "a.obj cannot be opened here; recordings (.hlr) and scenes (.hl.json) can.");
  });
});

test("a shown name is one line of bounded length", () => {
  expect(shownName("a\n\u0000b\u202e.obj")).toBe("ab.obj");
  expect(shownName("")).toBe("file");
  expect([...shownName("é".repeat(10_000))]).toHaveLength(60);
  expect(shownName("a\ud800.stl")).toBe("a.stl");
});

test("a long name keeps its ending, which says how the file is read", () => {
  expect(shownName(`${"long ".repeat(40)}.hl.json`)).toMatch(/^long .*….*\.hl\.json$/);
  expect([...shownName(`${"é".repeat(100)}.obj`)]).toHaveLength(60);
});

describe("a file that is given", () => {
  test("is opened, with lines on the way", async () => {
    const lines = new Lines();
    const drop = new FileDrop([opener("models", [".obj"], async (file, report) => {
      report("reading");
      return `${file.name} is open.`;
    })], lines);
    await drop.take([fileOf("a.obj")]);
    expect(lines).toMatchObject({ reported: ["good: a.obj is open."], stood: ["reading"], standing: undefined });
  });

  test("that opens without a word ends what was reported of files before", async () => {
    const lines = new Lines();
    await new FileDrop([opener("recordings", [".hlr"], async () => "")], lines).take([fileOf("a.hlr")]);
    expect(lines.reported).toEqual(["settled: file"]);
  });

  test("that fails gives its one line, and the next one is taken", async () => {
    const lines = new Lines();
    const drop = new FileDrop([opener("models", [".obj"], () => Promise.reject(new Error("no good")))], lines);
    await drop.take([fileOf("a.obj")]);
    await drop.take([fileOf("a.obj")]);
    expect(lines.reported).toEqual(["bad: no good", "bad: no good"]);
  });

  test("that is a folder, or has gone meanwhile, is said to be so, whatever its opener says", async () => {
    const lines = new Lines();
    const gone = fileOf("a.obj");
    gone.slice = () => ({ arrayBuffer: () => Promise.reject(new Error("not found")) }) as unknown as Blob;
    await new FileDrop([opener("models", [".obj"], () => Promise.reject(new Error("broke")))], lines).take([gone]);
    expect(lines.reported).toEqual([
      "bad: a.obj cannot be read: it is a folder, or it has been moved, changed or deleted. Give the file again.",
    ]);
  });

  test("waits for nobody: a second one is refused until it is given again", async () => {
    const lines = new Lines();
    let finish = (_: string) => {};
    const drop = new FileDrop([opener("models", [".obj"], () => new Promise((resolve) => (finish = resolve)))], lines);
    const first = drop.take([fileOf("a.obj")]);
    await drop.take([fileOf("b.obj")]);
    finish("done");
    await first;
    expect(lines.reported).toEqual(["bad: Busy with another file: give b.obj again when it is done.", "good: done"]);
  });

  test("of several, or of no known kind, or when nothing is opened now, is refused in a line", async () => {
    const lines = new Lines();
    const closed = { ...opener("models", [".obj"]), refusal: () => "This server takes no files." };
    const drop = new FileDrop([closed, opener("recordings", [".hlr"])], lines);
    await drop.take([]);
    await drop.take([fileOf("a.hlr"), fileOf("b.hlr")]);
    await drop.take([fileOf("a.xyz")]);
    await drop.take([fileOf("a.obj")]);
    expect(lines.reported).toEqual([
      "bad: 2 files at once: give one file.",
      "bad: a.xyz cannot be opened here; recordings (.hlr) can.",
      "bad: This server takes no files.",
    ]);
    expect(drop.offered).toBe(true);
    expect(new FileDrop([closed], lines).offered).toBe(false);
  });
});

test("a connection that broke is told apart from a bad file", async () => {
  const lines = new Lines();
  const broken = opener("models", [kAnyEnding], () => Promise.reject(new BrokenConnection("the connection broke")));
  await new FileDrop([broken], lines).take([fileOf("a.obj")]);
  expect(lines.reported).toEqual(["broke: the connection broke"]);
});
