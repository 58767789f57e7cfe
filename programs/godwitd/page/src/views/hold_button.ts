// A button that is held down to confirm what moves the vehicle: by pointer, or by Space or Enter. Letting go earlier does
// nothing, and says so.
import { html } from "lit";
import type { TemplateResult } from "lit";

export const hold_ms = 700;

export interface hold_options {
  id: string;
  label: string;
  hint: string;
  key?: string;
  tone?: string;
  is_held: boolean; // false: one press is enough
  is_disabled: boolean;
  is_busy: boolean;
  act(): void;
}

const timers = new WeakMap<HTMLElement, ReturnType<typeof setTimeout>>();

function begin(button: HTMLElement, act: () => void): void {
  if (timers.has(button)) return;
  button.classList.add("holding");
  timers.set(button, setTimeout(() => {
    end(button);
    act();
  }, hold_ms));
}

function end(button: HTMLElement): void {
  clearTimeout(timers.get(button));
  timers.delete(button);
  button.classList.remove("holding");
}

const is_press = (event: KeyboardEvent) => event.key === " " || event.key === "Enter";

export function hold_button(given: hold_options): TemplateResult {
  const on = (event: Event) => event.currentTarget as HTMLElement;
  const held = given.is_held && !given.is_disabled;
  return html`<button id=${given.id} class="act ${given.tone ?? ""} ${given.is_held ? "hold" : ""}" type="button"
      title=${given.hint} ?disabled=${given.is_disabled} aria-busy=${given.is_busy}
      @pointerdown=${(event: PointerEvent) => held && event.button === 0 && begin(on(event), given.act)}
      @pointerup=${(event: Event) => end(on(event))} @pointerleave=${(event: Event) => end(on(event))}
      @pointercancel=${(event: Event) => end(on(event))} @blur=${(event: Event) => end(on(event))}
      @contextmenu=${(event: Event) => given.is_held && event.preventDefault()}
      @keydown=${(event: KeyboardEvent) => {
        if (!held || !is_press(event)) return;
        event.preventDefault();
        if (!event.repeat) begin(on(event), given.act);
      }}
      @keyup=${(event: KeyboardEvent) => is_press(event) && end(on(event))}
      @click=${() => !given.is_held && given.act()}>
    <span>${given.label}</span>${given.key === undefined || given.key === "" ? "" : html`<kbd aria-hidden="true">${given.key}</kbd>`}
    ${given.is_held ? html`<small>hold</small>` : ""}
  </button>`;
}
