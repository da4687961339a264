// Keys 1 to 4, and those of a gamepad, as the buttons of a device that a simulated hand holds: down as long as the key is.

const kKeys = ["Digit1", "Digit2", "Digit3", "Digit4"];
/** The server lets a button up after a second of silence, so that a page that has gone presses nothing. */
const kSayAgain_ms = 300;

export class ButtonInput {
  /** False when a person holds the device: its buttons are theirs. */
  enabled = true;
  private down_ = 0;
  private keys_ = 0;
  private pad_ = 0;
  private timer_: number | undefined;
  private readonly press_: (buttons: number) => void;

  /** `press` sends to the server which buttons are down; bit i: button i. */
  constructor(press: (buttons: number) => void) {
    this.press_ = press;
    window.addEventListener("keydown", (event) => this.key(event, true));
    window.addEventListener("keyup", (event) => this.key(event, false));
    window.addEventListener("blur", () => this.keys(0));
  }

  /** What a gamepad holds down, besides the keys. */
  setPad(down: number): void {
    this.pad_ = this.enabled ? down : 0;
    this.set(this.keys_ | this.pad_);
  }

  private key(event: KeyboardEvent, down: boolean): void {
    const button = kKeys.indexOf(event.code);
    if (button < 0 || event.repeat || (down && (!this.enabled || event.ctrlKey || event.altKey || event.metaKey))) {
      return;
    }
    this.keys(down ? this.keys_ | (1 << button) : this.keys_ & ~(1 << button));
  }

  private keys(down: number): void {
    this.keys_ = down;
    this.set(this.keys_ | this.pad_);
  }

  private set(down: number): void {
    if (down === this.down_) {
      return;
    }
    this.down_ = down;
    this.press_(down);
    window.clearInterval(this.timer_);
    if (down !== 0) {
      this.timer_ = window.setInterval(() => this.press_(this.down_), kSayAgain_ms);
    }
  }
}
