// Logging in: by name and password, or by the word that `godwitd ctl login` prints on the vehicle's computer.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import type { page } from "../page.ts";

export function login_view(all: page): TemplateResult | typeof nothing {
  if (!all.shows_login) return nothing;
  const close = () => { all.shows_login = false; all.draw(); };
  const submit = (event: SubmitEvent) => {
    event.preventDefault();
    const said = new FormData(event.target as HTMLFormElement);
    const link = String(said.get("link") ?? "").trim();
    void all.log_in(link === "" ? { name: String(said.get("name") ?? ""), password: String(said.get("password") ?? "") } : { link });
  };
  return html`<div class="veil" @keydown=${(event: KeyboardEvent) => event.key === "Escape" && close()}>
    <form class="login" role="dialog" aria-modal="true" aria-labelledby="login-title" @submit=${submit}>
      <h2 id="login-title">Log in</h2>
      <label>Name <input name="name" autocomplete="username" autofocus></label>
      <label>Password <input name="password" type="password" autocomplete="current-password"></label>
      <p class="or">or, of <code>godwitd ctl login</code>:</p>
      <label>Link <input name="link" autocomplete="off" spellcheck="false"></label>
      ${all.login_refusal === "" ? nothing : html`<p class="refusal" role="alert">${all.login_refusal}</p>`}
      <div class="row"><button class="act primary" type="submit"><span>Log in</span></button>
        <button class="act" type="button" @click=${close}><span>Only look</span></button></div>
    </form>
  </div>`;
}
