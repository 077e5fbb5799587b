import { Loader } from "@mantine/core";

import { sentences } from "../../api/client";
import type { Mission, SegmentKind, SiteMap } from "../../api/types";
import { SEGMENT_COLORS } from "../../map/PlanLayer";
import { Card } from "../../ui/Card";
import { duration, way } from "../../ui/format";
import { Reasons } from "../../ui/Reasons";
import { SEGMENT_WORDS } from "../../ui/words";
import css from "../plan.module.css";
import { placeOf } from "./placeOf";
import type { MissionDraft } from "./useMissionDraft";

/** What the planner makes of the mission: length and duration, or everything that is wrong with it. */
export function PreviewCard({ site, draft, mission }: { site: SiteMap; draft: MissionDraft; mission: Mission }) {
  const preview = draft.preview;
  if (preview?.error) return <Reasons reasons={sentences(preview.error)} />;
  const data = preview?.data;
  if (!data) return <Loader />;
  const show = (problem: string) => draft.setPlace(placeOf(problem, site, mission));
  return (
    <Card>
      <div className={css.stack}>
        <Reasons reasons={data.problems} onPick={show} canPick={(problem) => placeOf(problem, site, mission) !== null} />
        {data.plan && (
          <div className={css.figures} data-old={preview.isPlaceholderData}>
            <div>
              Way <b>{way(data.length_m)}</b>
            </div>
            <div>
              Takes <b>{duration(data.duration_s)}</b>
            </div>
          </div>
        )}
        {data.plan && <Legend kinds={new Set(data.plan.segments.map(({ kind }) => kind))} />}
      </div>
    </Card>
  );
}

function Legend({ kinds }: { kinds: Set<SegmentKind> }) {
  return (
    <div className={css.legend}>
      {[...kinds].map((kind) => (
        <span key={kind}>
          <svg width="20" height="6" aria-hidden>
            <rect width="20" height="6" rx="3" fill={SEGMENT_COLORS[kind]} />
          </svg>
          {SEGMENT_WORDS[kind]}
        </span>
      ))}
      <span>dotted: in reverse</span>
    </div>
  );
}
