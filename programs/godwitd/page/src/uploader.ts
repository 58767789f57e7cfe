// A mission out of a file: looked at by godwitd, shown on the map, and handed over when somebody holds the button.
import type { mission_document } from "./model/messages.ts";
import { refusal_words } from "./model/commands.ts";
import { format_of_name, why_not_looked_at } from "./model/mission_file.ts";
import { send } from "./net/api.ts";
import type { page } from "./page.ts";

interface checked {
  mission: mission_document;
  losses: { item: number | null; what: string; why: string; instead: string }[];
}

export class uploader {
  name = ""; // of the file; empty: there is none
  checked: checked | undefined;
  refusal = "";
  taken = ""; // what was handed over
  is_busy = false;
  is_partial = false;
  private text = "";

  constructor(private readonly page: page) {}

  async take(file: File): Promise<void> {
    this.leave();
    this.name = file.name;
    this.refusal = why_not_looked_at(file.name, file.size);
    if (this.refusal === "") {
      this.text = await file.text();
      await this.check();
    }
    this.page.draw();
  }

  async check(): Promise<void> {
    const got = await this.post<checked>("/api/v1/missions/check");
    this.checked = got.ok ? got.what : undefined;
    this.refusal = got.ok ? "" : got.why.detail;
    this.page.show_preview(this.checked?.mission);
  }

  async set_partial(is_partial: boolean): Promise<void> {
    this.is_partial = is_partial;
    await this.check();
    this.page.draw();
  }

  async hand_over(): Promise<void> {
    if (this.checked === undefined || this.is_busy) return;
    this.is_busy = true;
    const got = await this.post<{ items: number }>("/api/v1/missions");
    this.is_busy = false;
    if (got.ok) {
      const { name } = this;
      this.leave();
      this.taken = `${name} was handed over: ${got.what.items} items. The checks look at it now.`;
    } else {
      this.refusal = refusal_words(got.why);
    }
    this.page.draw();
  }

  leave(): void {
    this.name = this.text = this.refusal = this.taken = "";
    this.checked = undefined;
    this.is_partial = false;
    this.page.show_preview(undefined);
    this.page.draw();
  }

  private post<T>(path: string) {
    const query = `?format=${format_of_name(this.name) ?? ""}${this.is_partial ? "&partial=yes" : ""}`;
    return send<T>("POST", path + query, { headers: { "Content-Type": "application/octet-stream" }, body: this.text });
  }
}

// A file that is dropped anywhere on the page.
export function listen_to_drops(all: page): void {
  const has_file = (event: DragEvent) => event.dataTransfer?.types.includes("Files") === true;
  document.addEventListener("dragover", (event) => has_file(event) && event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (!has_file(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file === undefined) return;
    all.drawer.open("missions");
    void all.uploader.take(file);
  });
}
