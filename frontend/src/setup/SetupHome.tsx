import { useQuery } from "@tanstack/react-query";

import { versionsQuery } from "../api/queries";
import type { Robot } from "../api/types";
import { useTopic } from "../live/hooks";
import { isUnderWay } from "../ui/words";
import { BeginCard } from "./BeginCard";
import { BoardCard } from "./BoardCard";
import { useBoardForm } from "./boardForm";
import { VersionList } from "./VersionList";
import css from "./setup.module.css";

/** Nothing is under way: what can be begun, with which board, and what was found before. */
export function SetupHome({ robot }: { robot: Robot }) {
  const [form, setForm] = useBoardForm();
  const versions = useQuery(versionsQuery).data ?? [];
  const driving = isUnderWay(useTopic("nav/status")?.state);
  return (
    <div className={css.home}>
      <h1>Setup</h1>
      {driving && <p className={css.notice}>A mission is under way. Calibrate when it has ended.</p>}
      <div className={css.begin}>
        <BeginCard job="camera" form={form} robot={robot} disabled={driving} versions={versions} />
        <BeginCard job="lidar" form={form} robot={robot} disabled={driving} versions={versions} />
        <BoardCard form={form} onChange={setForm} />
      </div>
      <VersionList versions={versions} disabled={driving} />
    </div>
  );
}
