// Which actors have crashed and are not back yet, as the executor says in the log at once; a report of all actors comes
// when the crashed one answers again. Pure.
import type { log_update } from "./messages.ts";

const says_crash = /^(\w+) crashed(?:: (.*))?$/;
const says_end = /^(\w+) (?:is back|is given up)/;

export const counts_ms = 5_000; // then the report knows

export class crashes {
  private readonly away = new Map<string, { reason: string; at: number }>(); // by actor

  // NOW, here and below: the browser's monotonic clock.
  hear(line: log_update, now: number): void {
    if (line.part !== "executor") return;
    const crash = says_crash.exec(line.sentence);
    if (crash?.[1] !== undefined) this.away.set(crash[1], { reason: crash[2] ?? "", at: now });
    const end = says_end.exec(line.sentence)?.[1];
    if (end !== undefined) this.away.delete(end);
  }

  // Undefined: it has not crashed, or is back.
  reason_of(actor: string, now: number): string | undefined {
    const crash = this.away.get(actor);
    return crash !== undefined && now - crash.at <= counts_ms ? crash.reason : undefined;
  }

  clear(): void {
    this.away.clear();
  }
}
