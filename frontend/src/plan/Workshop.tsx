import { SegmentedControl } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useCallback, useState } from "react";

import { rowProposalQuery } from "../api/queries";
import type { Point, SiteDocument } from "../api/types";
import { FitTo } from "../map/FitTo";
import { MapView } from "../map/MapView";
import { OrthophotoLayer } from "../map/OrthophotoLayer";
import { TrunkLayer } from "../map/TrunkLayer";
import { firstExtent, sitePoints } from "../map/fit";
import { Map3dLayer } from "../map/map3d/Map3dLayer";
import { useFirstSight } from "../map/map3d/useFirstSight";
import { useMap3dView } from "../map/map3d/useMap3dView";
import type { ItemRef } from "../map/siteFeatures";
import { useSiteFrame } from "../map/useSiteFrame";
import { EditLayer } from "./editing/EditLayer";
import { Toolbar } from "./editing/Toolbar";
import { reshape } from "./editing/edits";
import { drawn } from "./editing/drawn";
import type { Tool } from "./editing/tools";
import { useEditKeys } from "./editing/useEditKeys";
import { FarmPanel } from "./farm/FarmPanel";
import { SaveNotice } from "./farm/SaveNotice";
import { SiteHeader } from "./farm/SiteHeader";
import { MissionLayer } from "./mission/MissionLayer";
import { MissionPanel } from "./mission/MissionPanel";
import { useMissionDraft } from "./mission/useMissionDraft";
import css from "./plan.module.css";
import { ProposalLayer } from "./proposal/ProposalLayer";
import { useSiteEditor } from "./useSiteEditor";

type Tab = "farm" | "missions";

const TABS: { value: Tab; label: string }[] = [
  { value: "farm", label: "Farm" },
  { value: "missions", label: "Missions" },
];

/** One site: drawn on the map, and the missions through it. */
export function Workshop({ document, onReload }: { document: SiteDocument; onReload: () => void }) {
  const frame = useSiteFrame(document.site.datum);
  const editing = useSiteEditor(document);
  const [tab, setTab] = useState<Tab>(document.site.rows.length > 0 ? "missions" : "farm");
  const [tool, setTool] = useState<Tool>("select");
  const [selected, setSelected] = useState<ItemRef | null>(null);
  const draft = useMissionDraft(document);
  const found = useQuery(rowProposalQuery(document.id)).data ?? null;
  const { site, commit } = editing;
  const map3d = useMap3dView(document.id, document.orthophoto !== null);
  const ground = document.orthophoto ?? map3d.picture;
  const extent = useCallback(() => firstExtent(site, ground, frame), [site, ground, frame]);
  const sight = useFirstSight(document.id, !document.orthophoto && sitePoints(site).length < 2, map3d.picture !== null);
  const onDrawn = (with_: Tool, points: Point[]) => {
    const added = drawn(site, with_, points);
    setTool("select");
    if (!added) return;
    commit(added.site);
    setSelected(added.ref);
  };
  useEditKeys({ editing, selected: tab === "farm" ? selected : null, onSelect: setSelected, onTool: setTool });
  return (
    <div className={css.page}>
      <MapView className={css.map}>
        {document.orthophoto && <OrthophotoLayer siteId={document.id} orthophoto={document.orthophoto} />}
        <Map3dLayer siteId={document.id} view={map3d} />
        {tab === "farm" ? (
          <>
            <EditLayer site={site} frame={frame} tool={tool} selected={selected} onSelect={setSelected} onDrawn={onDrawn} onReshaped={(ref, points) => commit(reshape(site, ref, points))} onCancel={() => setTool("select")} />
            {found && <ProposalLayer site={site} found={found} frame={frame} />}
            <Toolbar tool={tool} onTool={setTool} onUndo={editing.undo} onRedo={editing.redo} />
          </>
        ) : (
          <>
            <MissionLayer site={site} frame={frame} draft={draft} />
            <TrunkLayer siteId={document.id} frame={frame} onDrive={draft.draft ? undefined : draft.pressTrunk} />
          </>
        )}
        <FitTo extent={extent} subject={sight} />
      </MapView>
      <aside className={css.side}>
        <SiteHeader document={document} editing={editing} />
        <SaveNotice editing={editing} siteId={document.id} onReload={onReload} />
        <SegmentedControl fullWidth size="lg" value={tab} onChange={(value) => setTab(value as Tab)} data={TABS} />
        {tab === "farm" ? (
          <FarmPanel document={document} editing={editing} found={found} selected={selected} onSelect={setSelected} />
        ) : (
          <MissionPanel document={document} site={site} draft={draft} />
        )}
      </aside>
    </div>
  );
}
