// What stands below the map: which tab, and what was fetched for it. A tab is fetched when it is opened and at what is
// heard of it; the actors at each beat of their health and once a second while they are shown.
import type { audit_row, preflight_view, status_report } from "../model/messages.ts";
import { ask } from "../net/api.ts";
import type { page } from "../page.ts";

export type tab_name = "plan" | "points" | "missions" | "plots" | "preflight" | "failsafe" | "actors" | "log" | "audit";

export const drawer_tabs: readonly { name: tab_name; label: string }[] = [
  { name: "plan", label: "Plan" },
  { name: "points", label: "Points" },
  { name: "missions", label: "Missions" },
  { name: "plots", label: "Plots" },
  { name: "preflight", label: "Preflight" },
  { name: "failsafe", label: "Failsafe" },
  { name: "actors", label: "Actors" },
  { name: "log", label: "Log" },
  { name: "audit", label: "Audit" },
];

const refresh_ms = 1_000;
const report_ms = 260; // a report of godwitd is up to 250 ms old: what has just happened may be in the next one only

export class drawer {
  tab: tab_name | undefined = "plan"; // none: it is closed
  status: status_report | undefined;
  preflight: preflight_view | undefined;
  audit: audit_row[] = [];
  refusal = "";
  filter = "";
  only_warnings = false;
  private fetched_at = 0;
  private is_fetching = false;

  constructor(private readonly page: page) {}

  show(tab: tab_name): void {
    this.tab = this.tab === tab ? undefined : tab;
    this.refusal = "";
    this.filter = "";
    this.refresh();
    this.page.draw();
  }

  open(tab: tab_name): void {
    if (this.tab !== tab) this.show(tab);
  }

  hear(topic: "health" | "log" | "flight"): void {
    const is_of_tab = this.tab === "actors" || this.tab === "failsafe" || (this.tab === "preflight" && topic === "flight");
    if (!is_of_tab) return;
    this.refresh();
    setTimeout(() => this.refresh(), report_ms);
  }

  look(now: number): void {
    if ((this.tab === "actors" || this.tab === "failsafe" || this.tab === "preflight" || this.tab === "audit") && now - this.fetched_at > refresh_ms)
      this.refresh();
  }

  refresh(): void {
    if (this.is_fetching) return;
    this.fetched_at = this.page.now();
    this.is_fetching = true;
    void this.fetch().finally(() => {
      this.is_fetching = false;
      this.page.draw();
    });
  }

  private async fetch(): Promise<void> {
    if (this.tab === "actors" || this.tab === "failsafe") {
      const got = await ask<status_report>("GET", "/status");
      if (got.ok) this.status = got.what;
      this.refusal = got.ok ? "" : got.why.detail;
    } else if (this.tab === "preflight") {
      const got = await ask<preflight_view>("GET", "/api/v1/preflight");
      if (got.ok) this.preflight = got.what;
      this.refusal = got.ok ? "" : got.why.detail;
    } else if (this.tab === "audit" && this.page.me !== undefined) {
      const got = await ask<{ rows: audit_row[] }>("GET", "/api/v1/audit?rows=200");
      if (got.ok) this.audit = got.what.rows;
      this.refusal = got.ok ? "" : got.why.detail;
    }
  }
}
