// The HTTP API of godwitd. An answer is the document, or why there is none; a line that breaks is status 0.
import type { problem } from "../model/messages.ts";

export type outcome<T> = { ok: true; what: T } | { ok: false; why: problem };

const patience_ms = 7_000; // godwitd answers within six seconds

export async function ask<T>(method: string, path: string, body?: unknown): Promise<outcome<T>> {
  const json = body === undefined ? {} : { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  return send<T>(method, path, json);
}

export async function send<T>(method: string, path: string, more: RequestInit): Promise<outcome<T>> {
  const ends = new AbortController();
  const timer = setTimeout(() => ends.abort(), patience_ms);
  try {
    const answer = await fetch(path, { method, ...more, signal: ends.signal, credentials: "same-origin" });
    const text = await answer.text();
    const document: unknown = text === "" ? {} : JSON.parse(text);
    if (answer.ok) return { ok: true, what: document as T };
    const said = document as Partial<problem>;
    return { ok: false, why: { ...said, status: answer.status, detail: said.detail ?? answer.statusText } };
  } catch {
    return { ok: false, why: { status: 0, detail: "godwitd does not answer" } };
  } finally {
    clearTimeout(timer);
  }
}
