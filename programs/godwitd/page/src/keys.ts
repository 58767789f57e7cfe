// Everything by keyboard: each button is reached by Tab; these keys lead straight to one. What moves the vehicle is held
// down there as well: the key leads to the button, and Space or Enter held confirms it.
import { command_rows, pointed_rows } from "./model/commands.ts";
import type { page } from "./page.ts";
import { drawer_tabs } from "./views/drawer_state.ts";

export function listen_to_keys(all: page): void {
  document.addEventListener("keydown", (event) => {
    const on = event.target as HTMLElement;
    if (event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|TEXTAREA|SELECT)$/.test(on.tagName)) return;
    const key = event.key;
    const row = command_rows.find((each) => each.key === key);
    const pointed = pointed_rows.find((each) => each.key === key);
    const tab = drawer_tabs[Number(key) - 1];
    if (row !== undefined) document.getElementById(`command-${row.name}`)?.focus();
    else if (pointed !== undefined) all.commander.begin_pointing(pointed.name);
    else if (key === "Escape") all.commander.end_pointing();
    else if (key === "f") all.see_all();
    else if (key === "v") all.follow();
    else if (key === "m") all.set_muted(!all.is_muted);
    else if (tab !== undefined) all.drawer.show(tab.name);
    else return;
    event.preventDefault();
  });
}
