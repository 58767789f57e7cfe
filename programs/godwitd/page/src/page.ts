// What the page knows and does, between the stream, the API and what is shown. Views read it and call it; it draws them
// anew at most once a frame.
import { html, render } from "lit";
import { chart } from "./map/chart.ts";
import { alarms } from "./model/alarms.ts";
import { crashes } from "./model/crashes.ts";
import { is_place } from "./model/geometry.ts";
import type { control_view, log_update, mission_document, place, plan_view, stream_text, text, tile_view, who } from "./model/messages.ts";
import { flight_history } from "./model/history.ts";
import { track } from "./model/track.ts";
import type { log_line } from "./model/world.ts";
import { world } from "./model/world.ts";
import { ask } from "./net/api.ts";
import { stream } from "./net/stream.ts";
import { commander } from "./commander.ts";
import { camera } from "./camera.ts";
import { objects } from "./objects.ts";
import { beep } from "./sound.ts";
import { uploader } from "./uploader.ts";
import { drawer } from "./views/drawer_state.ts";
import { page_view } from "./views/page_view.ts";
import { plots } from "./views/plots.ts";

const look_ms = 250; // between two looks at the age of all values
export type theme = "day" | "sun" | "night";

export class page {
  readonly world = new world();
  readonly alarms = new alarms();
  readonly crashes = new crashes();
  readonly track = new track();
  readonly history = new flight_history();
  readonly drawer = new drawer(this);
  readonly commander = new commander(this);
  readonly uploader = new uploader(this);
  readonly camera = new camera(() => this.draw());
  readonly objects = new objects(() => this.map?.shown_part(), (seen) => {
    this.map?.show_objects(seen.objects);
    this.draw();
  });
  me: who | undefined;
  control: control_view | undefined;
  login_refusal = "";
  shows_login = false;
  plan: plan_view | undefined;
  is_muted = localStorage.getItem("muted") === "yes";
  theme: theme = (localStorage.getItem("theme") as theme | null) ?? "day";
  private map: chart | undefined;
  private readonly plots = new plots();
  private readonly line: stream;
  private is_drawing = false;
  private is_giving = false; // control, by its holder's word
  private plan_of = ""; // the plan that was fetched last

  constructor(private readonly root: HTMLElement) {
    this.line = new stream({ on_open: () => this.opened(), on_text: (heard) => this.hear(heard), on_closed: () => this.closed() });
  }

  begin(): void {
    this.line.open(); // it is on its way while the map is made
    document.documentElement.dataset["theme"] = this.theme;
    this.draw_now();
    const where = document.getElementById("map");
    if (where !== null) this.map = new chart(where, (at) => this.commander.point_at(at), () => this.drawer.open("points"), () => this.objects.refresh());
    void this.find_tiles();
    setInterval(() => this.look(), look_ms);
    void this.log_in_by_address().then(() => this.find_session());
  }

  now(): number {
    return performance.now();
  }

  // -- what is heard --------------------------------------------------------------------------------

  private opened(): void {
    this.world.is_open = true;
    this.plan_of = "";
    void this.fetch_plan();
    void this.fetch_log();
    void this.find_session();
    this.drawer.refresh();
    this.objects.refresh();
    this.draw();
  }

  private closed(): void {
    this.world.is_open = false;
    this.draw();
  }

  private hear(heard: text | stream_text): void {
    if (this.world.take(heard, this.now())) this.forget();
    if (heard.topic === "clock") void this.beat();
    if (heard.topic === "position") this.move((heard as text<"position">));
    if (heard.topic === "progress") void this.fetch_plan();
    if (heard.topic === "home") this.show_home();
    if (heard.topic === "points") this.map?.show_points((heard as text<"points">).data);
    if (heard.topic === "traffic") this.map?.show_aircraft((heard as text<"traffic">).data.aircraft);
    if (heard.topic === "map") this.objects.refresh();
    if (heard.topic === "log") this.hear_line((heard as text<"log">).data);
    if (heard.topic === "health" || heard.topic === "log" || heard.topic === "flight") this.drawer.hear(heard.topic);
    this.look();
    this.draw();
  }

  private hear_line(line: log_update): void {
    this.crashes.hear(line, this.now());
    if (this.alarms.hear(line, this.world.godwit_ms(this.now())) && !this.is_muted) beep();
  }

  // It is another process; it may be another flight.
  private forget(): void {
    this.track.clear();
    this.history.clear();
    this.crashes.clear();
    this.map?.show_points(undefined);
    this.map?.show_aircraft([]);
  }

  private move(heard: text<"position">): void {
    const at = this.vehicle();
    if (at !== undefined) this.track.add(at);
    this.history.add({ at_ms: heard.at_ms, altitude_m: heard.data.altitude_m, speed_mps: heard.data.ground_speed_mps,
      battery_percent: this.world.get("battery")?.remaining_percent ?? null });
  }

  vehicle(): place | undefined {
    const at = this.world.get("position");
    const found = at === undefined ? undefined : { latitude: at.latitude_deg, longitude: at.longitude_deg };
    return is_place(found) ? found : undefined;
  }

  home(): place | undefined {
    const at = this.world.get("home");
    const found = at === undefined ? undefined : { latitude: at.latitude_deg, longitude: at.longitude_deg };
    return is_place(found) ? found : undefined;
  }

  // Each second, told by godwitd and not by a timer: those of hidden tabs come once a minute.
  private async beat(): Promise<void> {
    this.line.look();
    if (this.me === undefined) return;
    const got = await ask<control_view>("GET", "/api/v1/control");
    if (got.ok) this.take_control_view(got.what);
    else if (got.why.status === 401) this.lose_session();
    this.draw();
  }

  // Control that is gone without its holder's word is said.
  private take_control_view(heard: control_view): void {
    const is_lost = this.control?.is_yours === true && !heard.is_yours && !this.is_giving;
    this.control = heard;
    if (!is_lost) return;
    const words = heard.holder === "" ? "it is free" : `${heard.holder} has it`;
    this.alarms.raise("control", `You no longer have control: ${words}.`, this.world.godwit_ms(this.now()));
    if (!this.is_muted) beep();
  }

  private look(): void {
    this.line.look();
    this.drawer.look(this.now());
    if (this.alarms.look(this.world, this.now()) && !this.is_muted) beep();
    this.draw();
  }

  // -- what is fetched ------------------------------------------------------------------------------

  async fetch_plan(): Promise<void> {
    const progress = this.world.get("progress");
    const wanted = progress === undefined ? "" : `${progress.mission_id}/${progress.revision}/${progress.generation}`;
    if (wanted !== "" && wanted === this.plan_of) return;
    this.plan_of = wanted;
    const got = await ask<plan_view>("GET", "/api/v1/plan");
    if (!got.ok) {
      this.plan_of = "";
      return;
    }
    this.plan = got.what;
    this.map?.show_plan(got.what);
    this.show_home();
    this.draw();
  }

  private async find_tiles(): Promise<void> {
    const got = await ask<tile_view | null>("GET", "/api/v1/tiles");
    if (got.ok && got.what !== null) this.map?.show_tiles(got.what);
  }

  // A mission that was not handed over yet; none: it is left.
  show_preview(mission: mission_document | undefined): void {
    this.map?.show_preview(mission);
  }

  private show_home(): void {
    const home = this.home();
    if (home !== undefined) this.map?.show_home(home);
    else if (is_place(this.plan?.mission?.return_point)) this.map?.show_origin(this.plan.mission.return_point);
  }

  private async fetch_log(): Promise<void> {
    const got = await ask<{ lines: text<"log">[] }>("GET", "/api/v1/log");
    if (!got.ok) return;
    this.world.add_log(got.what.lines.map((each): log_line => ({ ...each.data, number: each.number, at_ms: each.at_ms })));
    this.draw();
  }

  // -- who is here ----------------------------------------------------------------------------------

  // http://...:8088/#login=WORD, as ./dev demo --page prints it. What comes after # is sent to nobody.
  private async log_in_by_address(): Promise<void> {
    const link = /^#login=([\w-]+)$/.exec(location.hash)?.[1];
    if (link === undefined) return;
    history.replaceState(null, "", location.pathname);
    await this.log_in({ link });
  }

  async find_session(): Promise<void> {
    const got = await ask<who>("GET", "/api/v1/session");
    if (got.ok) this.me = got.what;
    else if (got.why.status === 401) this.lose_session();
    this.draw();
  }

  async log_in(by: { link: string } | { name: string; password: string }): Promise<void> {
    const got = await ask<who>("POST", "/api/v1/session", by);
    this.login_refusal = got.ok ? "" : got.why.detail;
    if (got.ok) {
      this.me = got.what;
      this.shows_login = false;
      this.drawer.refresh();
    }
    this.draw();
  }

  async log_out(): Promise<void> {
    await ask("DELETE", "/api/v1/session");
    this.control = undefined;
    this.lose_session();
  }

  private lose_session(): void {
    if (this.me !== undefined && this.control?.is_yours === true)
      this.alarms.raise("session", "Your session is over, and with it your control.", this.world.godwit_ms(this.now()));
    this.me = undefined;
    this.control = undefined;
    this.draw();
  }

  async change_control(act: "take" | "take_over" | "give" | "hand_over", to = ""): Promise<void> {
    this.is_giving = act === "give" || act === "hand_over";
    const got = await ask<{ holder: string }>("POST", "/api/v1/control", to === "" ? { act } : { act, to });
    this.commander.refuse("control", got.ok ? "" : got.why.detail);
    const now = await ask<control_view>("GET", "/api/v1/control");
    if (now.ok) this.take_control_view(now.what);
    this.is_giving = false;
    this.draw();
  }

  // -- what is shown --------------------------------------------------------------------------------

  set_theme(wanted: theme): void {
    this.theme = wanted;
    localStorage.setItem("theme", wanted);
    document.documentElement.dataset["theme"] = wanted;
    this.map?.set_theme();
    if (this.objects.seen !== undefined) this.map?.show_objects(this.objects.seen.objects);
    if (this.plan !== undefined) this.map?.show_plan(this.plan);
    this.draw();
  }

  set_muted(is_muted: boolean): void {
    this.is_muted = is_muted;
    localStorage.setItem("muted", is_muted ? "yes" : "no");
    this.draw();
  }

  see_all(): void {
    const vehicle = this.vehicle();
    const way = this.plan === undefined ? [] : [...(this.plan.way.length > 0 ? this.plan.way : [])];
    this.map?.fit([...way, ...(vehicle === undefined ? [] : [vehicle])]);
  }

  see(places: place[]): void {
    this.map?.fit(places);
  }

  follow(): void {
    if (this.map !== undefined) this.map.follows = true;
    this.draw();
  }

  draw(): void {
    if (this.is_drawing) return;
    this.is_drawing = true;
    const then = () => {
      this.is_drawing = false;
      this.draw_now();
    };
    if (document.hidden) setTimeout(then, 0);
    else requestAnimationFrame(then);
  }

  private draw_now(): void {
    render(html`${page_view(this)}`, this.root);
    this.camera.show(document.querySelector<HTMLCanvasElement>("#camera"));
    this.plots.show(document.getElementById("plots"), this.history, this.theme, this.now());
    const map = this.map;
    const at = this.vehicle();
    if (map === undefined) return;
    const position = this.world.get("position");
    if (at !== undefined && position !== undefined) {
      map.show_vehicle(at, position.heading_deg, this.world.is_old("position", this.now()));
      map.show_track(this.track);
    }
    map.show_progress(this.world.get("progress")?.items_done ?? 0);
    map.set_pointing(this.commander.pointing !== undefined);
    map.show_way(this.commander.way(), this.commander.target);
  }
}
