// Dark and light. The page follows the system until the user chooses; the choice is remembered in this browser.

export type ThemeChoice = "system" | "light" | "dark";
export type Theme = "light" | "dark";

const kStorageKey = "hl-theme";

/** What the choice means on a system that prefers dark or not. */
export function resolveTheme(choice: ThemeChoice, systemDark: boolean): Theme {
  return choice === "system" ? (systemDark ? "dark" : "light") : choice;
}

/** A stored text as a choice; anything unexpected follows the system. */
export function parseChoice(stored: string | null): ThemeChoice {
  return stored === "light" || stored === "dark" ? stored : "system";
}

export class ThemeSwitch {
  private choice_: ThemeChoice;
  private readonly system_ = window.matchMedia("(prefers-color-scheme: dark)");
  private readonly changed_: (theme: Theme) => void;

  /** Calls `changed` immediately and on every change after. */
  constructor(changed: (theme: Theme) => void) {
    this.changed_ = changed;
    this.choice_ = parseChoice(readStorage());
    this.system_.addEventListener("change", () => this.apply());
    this.apply();
  }

  get choice(): ThemeChoice {
    return this.choice_;
  }

  choose(choice: ThemeChoice): void {
    this.choice_ = choice;
    writeStorage(choice);
    this.apply();
  }

  private apply(): void {
    const theme = resolveTheme(this.choice_, this.system_.matches);
    document.documentElement.dataset.theme = theme;
    this.changed_(theme);
  }
}

// Storage may be forbidden (private windows): then the choice lasts as long as the page.
function readStorage(): string | null {
  try {
    return localStorage.getItem(kStorageKey);
  } catch {
    return null;
  }
}

function writeStorage(choice: ThemeChoice): void {
  try {
    localStorage.setItem(kStorageKey, choice);
  } catch {
    return;
  }
}

/** Colours of the style sheet, for what the style sheet cannot reach: canvas plots and the 3-D scene. */
export function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
