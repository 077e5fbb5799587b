import { ActionIcon, CloseButton, Paper } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { IconTrees } from "@tabler/icons-react";
import type { MapBrowserEvent } from "ol";
import { useEffect, useState } from "react";

import { trunksQuery } from "../api/queries";
import type { Trunk } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { useMap } from "./MapView";
import { TrunkCard } from "./TrunkCard";
import { TrunkMenu } from "./TrunkMenu";
import { Z, useVectorLayer } from "./layer";
import css from "./trunks.module.css";
import { trunkAt } from "./trunkAt";
import { trunkFeatures, trunkStyle } from "./trunkFeatures";

interface Props {
  siteId: string;
  frame: SiteFrame;
  /** Makes the mission to a trunk beside a row; without it trunks are only looked at. */
  onDrive?: (rowId: string, trunkId: string) => void;
}

/** The site's trunks, with a switch; a press on one tells about it. */
export function TrunkLayer({ siteId, frame, onDrive }: Props) {
  const map = useTrunkMap(siteId);
  // Until somebody presses the switch: shown where there are any.
  const [wanted, setWanted] = useState<boolean | null>(null);
  const trunks = map?.trunks ?? [];
  const shown = wanted ?? trunks.length > 0;
  const [chosen, setChosen] = useState<Trunk | null>(null);
  return (
    <>
      <ActionIcon className={css.switch} aria-pressed={shown} onClick={() => setWanted(!shown)} aria-label="Show the trunks" title="Show the trunks">
        <IconTrees size={26} />
      </ActionIcon>
      {shown && trunks.length > 0 && <Dots trunks={trunks} frame={frame} onChoose={setChosen} />}
      {shown && map && trunks.length === 0 && <NoTrunks siteId={siteId} onClose={() => setWanted(false)} />}
      {shown && chosen && <TrunkCard siteId={siteId} trunk={chosen} onDrive={onDrive} onClose={() => setChosen(null)} />}
    </>
  );
}

function useTrunkMap(siteId: string) {
  return useQuery(trunksQuery(siteId)).data;
}

function Dots({ trunks, frame, onChoose }: { trunks: readonly Trunk[]; frame: SiteFrame; onChoose: (trunk: Trunk) => void }) {
  const map = useMap();
  const source = useVectorLayer(Z.trunks, trunkStyle, true);
  useEffect(() => {
    source.clear(true);
    source.addFeatures(trunkFeatures(trunks, frame));
  }, [source, trunks, frame]);
  useEffect(() => {
    const onClick = (event: MapBrowserEvent) => {
      const hit = trunkAt(map, event.pixel);
      if (hit) onChoose(hit);
    };
    map.on("singleclick", onClick);
    return () => map.un("singleclick", onClick);
  }, [map, onChoose]);
  return null;
}

function NoTrunks({ siteId, onClose }: { siteId: string; onClose: () => void }) {
  return (
    <Paper className={css.card} shadow="md" p="sm">
      <span>No trunks are mapped yet. They appear after a run through a row with a 2D LiDAR, or from a file.</span>
      <TrunkMenu siteId={siteId} onDeleted={onClose} />
      <CloseButton size="xl" onClick={onClose} aria-label="Close" />
    </Paper>
  );
}
