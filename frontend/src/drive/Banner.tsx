import type { MissionDocument, Preview, SiteDocument } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { way } from "../ui/format";
import { Reasons } from "../ui/Reasons";
import { headline, why } from "../ui/headline";
import { MODE_COLORS } from "../ui/words";
import { Controls } from "./Controls";
import { asksForPlace } from "./placing";
import css from "./drive.module.css";

interface Props {
  document: SiteDocument;
  missions: MissionDocument[];
  mission: MissionDocument | null;
  preview: Preview | undefined;
  onMission: (id: string) => void;
}

const NEXT = "Choose a mission, then press Start.";

/** Events for which the page asks where the robot stands. */
const TOLD_BY_THE_CARD = ["place_unknown", "no_position", "position_unsure"];

/** What the robot does and why, in one line; beside it what the operator can do about it. */
export function Banner(props: Props) {
  const status = useTopic("nav/status");
  const fresh = useFresh("nav/status");
  const names = new Map(props.document.site.rows.map(({ id, name }) => [id, name]));
  const color = fresh && status?.state === "driving" ? MODE_COLORS[status.mode] : "transparent";
  const stopped = fresh && !!status?.stop_reason;
  const asked = asksForPlace(status) ? TOLD_BY_THE_CARD : [];
  const events = (fresh && status?.events.filter(({ name, text }) => !status.stop_reason.includes(text) && !asked.includes(name))) || []; // what stopped it is told above
  return (
    <section className={css.banner} style={{ "--mode": color } as React.CSSProperties}>
      <div className={css.words} aria-live="polite">
        <h1>{fresh && status ? headline(status, names) : "No news from the robot"}</h1>
        <p className={stopped ? css.stopped : undefined}>{fresh && status ? why(status) || (events.length === 0 && asked.length === 0 && NEXT) : "Controls are off until data arrive. STOP still works."}</p>
      </div>
      {status && fresh && status.run_id && status.state !== "idle" && <Progress progress={status.progress} remaining={status.remaining} />}
      <Controls {...props} />
      {events.length > 0 && (
        <div className={css.events}>
          <Reasons reasons={events.map(({ text }) => text)} tone={events.some(({ effect }) => effect === "STOP") ? "bad" : "warn"} />
        </div>
      )}
    </section>
  );
}

function Progress({ progress, remaining }: { progress: number; remaining: number }) {
  return (
    <div className={css.progress}>
      <progress value={progress} max={1} aria-label="Driven part of the mission" />
      <span>
        {Math.round(progress * 100)} % · {way(remaining)} to go
      </span>
    </div>
  );
}
