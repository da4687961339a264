// The button that records the session on the server, and the line about it. The recording of another page is
// shown too; there is one at a time.

import { element, setText } from "./elements";
import { PageRecording_Phase as Phase, type PageRecording } from "./gen/hl_pb";
import { RecordingClerk, type RecordingNews } from "./recording_clerk";
import { fileName } from "./save";

/** Sends what the page wants recorded. */
export type SendRecord = (on: boolean, owner: number) => void;

export class RecordPanel {
  private readonly clerk_: RecordingClerk;

  constructor(
    send: SendRecord, private readonly sceneName_: () => string,
    private readonly report_: (text: string, bad: boolean) => void) {
    this.clerk_ = new RecordingClerk(send);
    element("record").addEventListener("click", () => this.clerk_.press(newOwner()));
  }

  /** With each state of the server, whatever the page shows. */
  hear(recording: PageRecording | undefined, now_ms: number): void {
    element("record").hidden = recording === undefined;
    const news = this.clerk_.hear(recording, now_ms);
    this.show(recording, news);
  }

  /** The server is not heard: what it sent last may no longer hold. */
  lose(): void {
    element<HTMLButtonElement>("record").disabled = true;
    element("record-told").hidden = true;
  }

  private show(recording: PageRecording | undefined, news: RecordingNews): void {
    const button = element<HTMLButtonElement>("record");
    button.disabled = news.ofAnother;
    setText("record", news.own ? "Stop recording" : "Record");
    button.title = news.limits;
    element("record-told").hidden = news.line === "";
    setText("record-told", news.line);
    if (news.refused !== undefined) {
      this.report_(news.refused, true);
    }
    if (news.ready !== undefined && recording?.phase === Phase.READY) {
      this.fetch(news.ready);
      this.report_(`The recording is saved (${news.end}). hl replay runs it again; this page opens it.`, false);
    }
  }

  /** The browser takes it piece by piece: it need not fit into the page. */
  private fetch(owner: number): void {
    const link = document.createElement("a");
    link.href = `recording.hlr?owner=${owner}`;
    link.download = fileName(this.sceneName_(), new Date(), "hlr");
    link.click();
  }
}

function newOwner(): number {
  return crypto.getRandomValues(new Uint32Array(1))[0]! || 1;
}
