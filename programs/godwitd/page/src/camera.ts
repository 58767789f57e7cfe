// The live picture of the camera, on a canvas, as long as somebody looks at it: godwitd makes pictures only while they
// are asked for. The next one is asked for when the one before is there, so a slow line has fewer and no older ones.
import { ask_picture } from "./net/api.ts";

const gap_ms = 150; // between two pictures
const retry_ms = 600; // the first picture needs half a second
const longest_retry_ms = 3_000;
export const old_picture_ms = 2_000;

export class camera {
  why_none = ""; // a sentence; empty: there is a picture, or nobody has asked yet
  private number = 0; // of the picture that is shown
  private captured_at = -Infinity; // by the clock of the browser
  private where: HTMLCanvasElement | null = null;
  private drawn_on: HTMLCanvasElement | null = null;
  private is_running = false;
  private wait_ms = retry_ms;

  constructor(private readonly draw: () => void) {}

  // WHERE: none while nobody looks.
  show(where: HTMLCanvasElement | null): void {
    this.where = where;
    if (where === null) this.forget();
    if (where === null || document.hidden || this.is_running) return;
    this.is_running = true;
    void this.run().finally(() => { this.is_running = false; });
  }

  has_picture(): boolean {
    return this.number !== 0;
  }

  age_ms(now: number): number {
    return Math.max(0, now - this.captured_at);
  }

  private async run(): Promise<void> {
    while (this.where !== null && !document.hidden) {
      const wait_ms = await this.take_one();
      this.draw();
      await new Promise((then) => setTimeout(then, wait_ms));
    }
  }

  // Milliseconds until the next one.
  private async take_one(): Promise<number> {
    // Who has seen nothing new for a while may have missed that numbers began anew.
    const got = await ask_picture(this.age_ms(performance.now()) > old_picture_ms ? 0 : this.number);
    if (!got.ok) {
      this.why_none = got.why.detail;
      this.wait_ms = Math.min(longest_retry_ms, 1.5 * this.wait_ms);
      return this.wait_ms;
    }
    this.wait_ms = retry_ms;
    this.why_none = "";
    const { where } = this;
    if (got.what === undefined || where === null) return gap_ms;
    const picture = await createImageBitmap(got.what.jpeg).catch(() => undefined);
    if (picture === undefined) return retry_ms; // cut off on its way
    this.number = got.what.number;
    this.captured_at = performance.now() - got.what.age_ms;
    where.width = picture.width;
    where.height = picture.height;
    where.getContext("2d")?.drawImage(picture, 0, 0);
    picture.close();
    this.drawn_on = where;
    return gap_ms;
  }

  private forget(): void {
    if (this.drawn_on === null && this.why_none === "") return;
    this.drawn_on = null;
    this.number = 0;
    this.captured_at = -Infinity;
    this.why_none = "";
    this.wait_ms = retry_ms;
  }
}
