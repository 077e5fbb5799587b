import { Loader, Menu, SegmentedControl } from "@mantine/core";
import { IconDownload, IconRoute, IconTrash } from "@tabler/icons-react";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";

import { remove } from "../../api/client";
import { missionsQuery } from "../../api/queries";
import type { MissionDocument, RowExit, SiteDocument, SiteMap } from "../../api/types";
import { Card } from "../../ui/Card";
import { EmptyState } from "../../ui/EmptyState";
import { MoreButton } from "../../ui/MoreButton";
import { notifyDone } from "../../ui/notify";
import { nextStep } from "../farm/nextStep";
import { GeoJsonButton } from "../imports/GeoJsonButton";
import css from "../plan.module.css";
import { EXITS } from "./exits";
import type { MissionDraft } from "./useMissionDraft";

/** Press a row for a new mission, or open one. */
export function MissionList({ document, site, draft }: { document: SiteDocument; site: SiteMap; draft: MissionDraft }) {
  const client = useQueryClient();
  const missions = useQuery(missionsQuery(document.id)).data;
  const missing = site.rows.length === 0 || !site.warehouse ? nextStep(site) : null;
  if (missing) {
    return (
      <EmptyState icon={IconRoute} title="No mission yet">
        A mission needs a warehouse and a row. Open “Farm” above. {missing}
      </EmptyState>
    );
  }
  return (
    <div className={css.stack}>
      <Card title="New mission">
        <p className={css.quiet}>Press a row on the map: the way there and back is made for you. At the far end of the row:</p>
        <SegmentedControl mt="xs" fullWidth value={draft.exit} onChange={(exit) => draft.setExit(exit as RowExit)} data={EXITS} />
        {draft.making && <Loader mt="md" />}
      </Card>
      <Card title="Missions on this farm">
        <div className={css.stack}>
          <ul className={css.list}>
            {missions?.map((mission) => <MissionItem key={mission.id} mission={mission} onOpen={() => draft.open(mission)} />)}
          </ul>
          {missions?.length === 0 && <p className={css.quiet}>None yet.</p>}
          <GeoJsonButton path={`/api/sites/${document.id}/missions/import`} word="Import GeoJSON" onDone={() => void client.invalidateQueries({ queryKey: ["missions"] })} />
        </div>
      </Card>
    </div>
  );
}

function MissionItem({ mission, onOpen }: { mission: MissionDocument; onOpen: () => void }) {
  const client = useQueryClient();
  const erase = useMutation({
    mutationFn: () => remove(`/api/missions/${mission.id}`),
    onSuccess: () => {
      void client.invalidateQueries({ queryKey: ["missions"] });
      notifyDone(`“${mission.name}” was deleted.`);
    },
  });
  const ask = () => window.confirm(`Delete the mission “${mission.name}”?`) && erase.mutate();
  return (
    <li className={css.header}>
      <button type="button" className={`${css.item} ${css.tall}`} onClick={onOpen}>
        {mission.name}
        <small>{mission.mission.visits.length === 1 ? "1 row" : `${mission.mission.visits.length} rows`}</small>
      </button>
      <MoreButton label={`More for ${mission.name}`} loading={erase.isPending}>
        <Menu.Item component="a" href={`/api/missions/${mission.id}/geojson`} download leftSection={<IconDownload size={20} />}>
          Export as GeoJSON
        </Menu.Item>
        <Menu.Item color="red" leftSection={<IconTrash size={20} />} onClick={ask}>
          Delete …
        </Menu.Item>
      </MoreButton>
    </li>
  );
}
