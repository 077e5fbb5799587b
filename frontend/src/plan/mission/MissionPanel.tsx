import type { SiteDocument, SiteMap } from "../../api/types";
import { DraftPanel } from "./DraftPanel";
import { MissionList } from "./MissionList";
import type { MissionDraft } from "./useMissionDraft";

export function MissionPanel({ document, site, draft }: { document: SiteDocument; site: SiteMap; draft: MissionDraft }) {
  return draft.draft ? <DraftPanel site={site} draft={draft} /> : <MissionList document={document} site={site} draft={draft} />;
}
