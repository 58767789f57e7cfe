// The HTTP API of godwitd. An answer is the document, or why there is none; a line that breaks is status 0.
import type { problem } from "../model/messages.ts";

export type outcome<T> = { ok: true; what: T } | { ok: false; why: problem };

const patience_ms = 7_000; // godwitd answers within six seconds

export async function ask<T>(method: string, path: string, body?: unknown): Promise<outcome<T>> {
  const json = body === undefined ? {} : { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  return send<T>(method, path, json);
}

export async function send<T>(method: string, path: string, more: RequestInit): Promise<outcome<T>> {
  return fetched(method, path, more, async (answer) => {
    const text = await answer.text();
    return (text === "" ? {} : JSON.parse(text)) as T;
  });
}

export interface picture {
  number: number;
  age_ms: number; // when it was sent
  jpeg: Blob;
}

// The newest with a number above AFTER; undefined: there is none yet.
export async function ask_picture(after: number): Promise<outcome<picture | undefined>> {
  return fetched("GET", `/api/v1/camera/picture?after=${after}`, {}, async (answer) => answer.status === 204 ? undefined : {
    number: Number(answer.headers.get("Godwit-Picture")), age_ms: Number(answer.headers.get("Godwit-Age-Ms")), jpeg: await answer.blob() });
}

async function fetched<T>(method: string, path: string, more: RequestInit, read: (answer: Response) => Promise<T>): Promise<outcome<T>> {
  const ends = new AbortController();
  const timer = setTimeout(() => ends.abort(), patience_ms);
  try {
    const answer = await fetch(path, { method, ...more, signal: ends.signal, credentials: "same-origin" });
    if (answer.ok) return { ok: true, what: await read(answer) };
    const said = JSON.parse(await answer.text()) as Partial<problem>;
    return { ok: false, why: { ...said, status: answer.status, detail: said.detail ?? answer.statusText } };
  } catch {
    return { ok: false, why: { status: 0, detail: "godwitd does not answer" } };
  } finally {
    clearTimeout(timer);
  }
}
