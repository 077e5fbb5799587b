import { StationError } from "./client";

/** Sends a file with progress (0 to 1); fetch cannot tell how much of a body has left. */
export function upload<T>(path: string, file: File, onProgress: (fraction: number) => void): Promise<T> {
  return new Promise((resolve, reject) => {
    const xhr = new XMLHttpRequest();
    xhr.open("POST", path);
    xhr.setRequestHeader("X-Rowpilot", "1");
    xhr.setRequestHeader("Content-Type", "application/octet-stream");
    xhr.upload.onprogress = (event) => onProgress(event.lengthComputable ? event.loaded / event.total : 0);
    xhr.onerror = () => reject(new StationError(0, "The upload broke off. Send the file again."));
    xhr.onload = () => {
      const body = parse(xhr.responseText);
      if (xhr.status < 300) resolve(body as T);
      else reject(new StationError(xhr.status, body?.message ?? `The upload was refused (${xhr.status}).`, body?.reasons));
    };
    xhr.send(file);
  });
}

function parse(text: string): { message?: string; reasons?: string[] } | null {
  try {
    return JSON.parse(text) as { message?: string; reasons?: string[] };
  } catch {
    return null;
  }
}
