/** The one way to ask the station for something. */

/** What the station answered instead: one sentence, and every reason where there are several. */
export class StationError extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly reasons: string[] = [],
  ) {
    super(message);
    this.name = "StationError";
  }
}

type Method = "GET" | "POST" | "PUT" | "DELETE";

const UNREACHABLE = "The station does not answer. Check that the robot is on and that this device is in its network.";

async function failure(response: Response): Promise<StationError> {
  const body: unknown = await response.json().catch(() => null);
  const { message, reasons } = (body ?? {}) as { message?: string; reasons?: string[] };
  return new StationError(response.status, message ?? `The station refused (${response.status}).`, reasons ?? []);
}

/** Sends a request; throws StationError with the station's own sentence. `body` may be a Blob, sent as it is. */
export async function request(method: Method, path: string, body?: unknown, signal?: AbortSignal): Promise<Response> {
  const headers: Record<string, string> = { "X-Rowpilot": "1" };
  const raw = body instanceof Blob;
  if (body !== undefined) headers["Content-Type"] = raw ? "application/octet-stream" : "application/json";
  const sent = raw ? body : body === undefined ? undefined : JSON.stringify(body);
  const response = await fetch(path, { method, headers, body: sent, signal, credentials: "same-origin" }).catch(
    (error: unknown) => {
      if (error instanceof DOMException && error.name === "AbortError") throw error;
      throw new StationError(0, UNREACHABLE);
    },
  );
  if (!response.ok) throw await failure(response);
  return response;
}

async function json<T>(method: Method, path: string, body?: unknown, signal?: AbortSignal): Promise<T> {
  const response = await request(method, path, body, signal);
  const text = await response.text();
  return (text === "" ? undefined : JSON.parse(text)) as T;
}

export const get = <T>(path: string, signal?: AbortSignal) => json<T>("GET", path, undefined, signal);
export const post = <T>(path: string, body?: unknown) => json<T>("POST", path, body);
export const put = <T>(path: string, body: unknown) => json<T>("PUT", path, body);
export const remove = (path: string) => json<void>("DELETE", path);

/** Every sentence of an error, the general one first. */
export function sentences(error: unknown): string[] {
  if (error instanceof StationError) return [error.message, ...error.reasons.filter((r) => r !== error.message)];
  return [error instanceof Error ? error.message : String(error)];
}
