// The energy ledger on the page: what mode it is in, and how full its tank is. Its plot is one of plots.ts.

import { element, setText } from "./elements";
import { LedgerMode, type Ledger } from "./gen/hl_pb";
import { Pending } from "./pending";
import type { SettingsChange } from "./protocol";
import { formatFixed, kUnknown } from "./units";

/** The tank never holds more, whatever is dissipated. */
const kTankFull_mJ = 50;
const kControl = "ledger";
const kIds: Readonly<Record<LedgerMode, string>> = {
  [LedgerMode.TANK]: "ledger-tank",
  [LedgerMode.STRICT]: "ledger-strict",
  [LedgerMode.REPORT]: "ledger-report",
};

export class LedgerPanel {
  private readonly pending_ = new Pending<LedgerMode>();

  constructor(send: (change: SettingsChange) => void) {
    element<HTMLProgressElement>("tank-level").max = kTankFull_mJ;
    for (const mode of [LedgerMode.TANK, LedgerMode.STRICT, LedgerMode.REPORT]) {
      element(kIds[mode]).addEventListener("change", () => {
        this.pending_.set(kControl, mode, performance.now());
        send({ ledger: mode });
      });
    }
  }

  /** Another server: what was chosen for the one before is past. */
  forget(): void {
    this.pending_.clear();
  }

  show(ledger: Ledger | undefined): void {
    const mode = this.pending_.resolve(kControl, ledger?.mode ?? LedgerMode.TANK, performance.now());
    // A mode that this page does not know checks nothing.
    if (mode in kIds) {
      element<HTMLInputElement>(kIds[mode]).checked = true;
    }
    element("tank-row").classList.toggle("idle", mode !== LedgerMode.TANK);
    const tank_mJ = ledger === undefined ? NaN : 1e3 * ledger.tankJ;
    const known = Number.isFinite(tank_mJ);
    element<HTMLProgressElement>("tank-level").value = known ? tank_mJ : 0;
    setText("tank", known ? `${tank_mJ.toFixed(1)} of ${formatFixed(kTankFull_mJ, "mJ", 0)}` : kUnknown);
  }
}
