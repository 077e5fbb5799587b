/** The live feed, out of the page's own thread: a drawing that holds the page up must not look like a lost link. */
import { type Arrived, Mailbox } from "./mailbox";
import { type LinkState, LiveSocket } from "./socket";
import { Vigil } from "./vigil";

export type ToWorker = { kind: "open"; url: string } | { kind: "alive"; hidden: boolean } | { kind: "read" };
export type FromWorker = { kind: "state"; state: LinkState } | { kind: "news"; messages: Arrived[] };

const tell = (message: FromWorker) => self.postMessage(message);

const vigil = new Vigil();
const mailbox = new Mailbox((messages) => tell({ kind: "news", messages }));

function open(url: string): void {
  const socket = new LiveSocket(url, {
    onState: (state) => tell({ kind: "state", state }),
    onMessage: (message) => mailbox.put({ ...message, arrived: performance.timeOrigin + performance.now() }),
    isWatched: () => vigil.isKept(performance.now()),
  });
  socket.open();
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.kind === "open") open(data.url);
  else if (data.kind === "read") mailbox.read();
  else vigil.tell(data.hidden, performance.now());
};
