import { SegmentedControl } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";

import { useChosenMission } from "../api/chosenMission";
import { missionsQuery, previewQuery } from "../api/queries";
import type { MissionPlan, Robot, SiteDocument } from "../api/types";
import { useTopic } from "../live/hooks";
import { ScanView } from "../scan/ScanView";
import { isUnderWay } from "../ui/words";
import { Banner } from "./Banner";
import { DriveMap } from "./DriveMap";
import { Gauges } from "./Gauges";
import { LiveCamera } from "./LiveCamera";
import { Logbook } from "./Logbook";
import { PlaceCard } from "./PlaceCard";
import { SceneView } from "./SceneView";
import css from "./drive.module.css";
import { usePlacing } from "./usePlacing";
import { useRecordedStart } from "./useRecordedStart";

type ViewName = "map" | "scene" | "scan" | "camera";

const WIDE: { value: ViewName; label: string }[] = [
  { value: "map", label: "Map" },
  { value: "scene", label: "3D" },
  { value: "scan", label: "Scan" },
];
const NARROW = [...WIDE, { value: "camera" as const, label: "Camera" }];

export function DriveView({ robot, document }: { robot: Robot; document: SiteDocument }) {
  const narrow = useMediaQuery("(max-width: 720px)", false, { getInitialValueInEffect: false });
  const [chosen, setView] = useState<ViewName>("map");
  const [missionId, setMissionId] = useChosenMission(document.id);
  const missions = useQuery(missionsQuery(document.id)).data ?? [];
  const mission = missions.find(({ id }) => id === missionId) ?? missions[0] ?? null;
  const preview = useQuery(previewQuery(document.id, mission?.mission ?? null, document.version));
  const plan = useShownPlan(preview.data?.plan ?? null);
  const { placing, open } = usePlacing(document);
  useRecordedStart();
  const view = chosen === "camera" && !narrow ? "map" : chosen;
  return (
    <div className={css.page}>
      <Banner document={document} missions={missions} mission={mission} preview={preview.data} onMission={setMissionId} />
      <section className={css.main}>
        <SegmentedControl className={css.views} value={view} onChange={(value) => setView(value as ViewName)} data={narrow ? NARROW : WIDE} />
        {view === "map" && <DriveMap document={document} robot={robot} plan={plan} placing={placing} onPlace={open} onMission={setMissionId} />}
        {view === "scene" && <SceneView available={robot.scene} />}
        {view === "scan" && <ScanView />}
        {view === "camera" && <LiveCamera />}
        {placing && <PlaceCard placing={placing} onMap={view === "map"} onShowMap={() => setView("map")} />}
      </section>
      <aside className={css.side}>
        {!narrow && <LiveCamera />}
        <Gauges />
        <Logbook />
      </aside>
    </div>
  );
}

/** While a mission is under way its own plan is shown, else that of the chosen mission. */
function useShownPlan(preview: MissionPlan | null): MissionPlan | null {
  const driven = useTopic("nav/plan");
  const underWay = isUnderWay(useTopic("nav/status")?.state);
  return underWay ? (driven ?? preview) : preview;
}
