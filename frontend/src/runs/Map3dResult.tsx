import { Button, Group, Menu, Modal } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { IconDownload, IconTrash } from "@tabler/icons-react";
import { useState } from "react";

import { remove, sentences } from "../api/client";
import type { Map3d } from "../api/types";
import { bytes, centimetres, moment, percent, way } from "../ui/format";
import { MoreButton } from "../ui/MoreButton";
import { Reasons } from "../ui/Reasons";
import { UseMap3d } from "./UseMap3d";
import css from "./runs.module.css";

const NAMES: Record<string, string> = { "map.ndt": "NDT map", "cloud.laz": "Cloud, LAZ", "cloud.pcd": "Cloud, PCD", "report.json": "Report" };

/** What a map is good for, and its files. */
export function Map3dResult({ siteId, map }: { siteId: string; map: Map3d }) {
  const [asked, setAsked] = useState(false);
  const url = `/api/sites/${siteId}/maps3d/${map.run_id}`;
  return (
    <>
      <Reasons reasons={map.doubts} tone="warn" />
      <dl className={css.numbers}>
        {figures(map).map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <UseMap3d siteId={siteId} map={map} />
      <MoreButton label="Files of the 3D map">
        {map.files.map((file) => (
          <Menu.Item key={file.name} component="a" href={`${url}/files/${file.name}`} download leftSection={<IconDownload size={20} />}>
            {NAMES[file.name] ?? file.name}, {bytes(file.size_bytes)}
          </Menu.Item>
        ))}
        <Menu.Item color="red" leftSection={<IconTrash size={20} />} onClick={() => setAsked(true)}>
          Throw away …
        </Menu.Item>
      </MoreButton>
      {asked && <ThrowAway url={url} runId={map.run_id} onClose={() => setAsked(false)} />}
    </>
  );
}

const figures = (map: Map3d): [string, string][] => [
  ["Made", moment(map.made)],
  ["Way", way(map.driven)],
  ["Area", `${map.hectares.toFixed(2)} ha`],
  ["On the Earth", map.georeferenced ? `yes, RTK ${percent(map.rtk_share)} of the way` : "no"],
  ["RTK fits within", centimetres(map.fix_rms)],
  ["Places passed twice", `${map.loops_taken}`],
];

function ThrowAway({ url, runId, onClose }: { url: string; runId: string; onClose: () => void }) {
  const client = useQueryClient();
  const erase = useMutation({
    mutationFn: () => remove(url),
    onSuccess: () => {
      onClose();
      return Promise.all([client.invalidateQueries({ queryKey: ["map3d", runId] }), client.invalidateQueries({ queryKey: ["maps3d"] })]);
    },
  });
  return (
    <Modal opened onClose={onClose} title={<b>Throw this 3D map away?</b>}>
      <p>Its files are deleted. The run stays, and the map can be made of it again.</p>
      {erase.error && <Reasons reasons={sentences(erase.error)} />}
      <Group grow>
        <Button size="md" variant="default" onClick={onClose} data-autofocus>
          Keep it
        </Button>
        <Button size="md" color="red" loading={erase.isPending} onClick={() => erase.mutate()}>
          Throw it away
        </Button>
      </Group>
    </Modal>
  );
}
