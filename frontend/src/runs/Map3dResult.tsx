import { Button, Group, Modal } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { IconDownload, IconTrash } from "@tabler/icons-react";
import { useState } from "react";

import { remove, sentences } from "../api/client";
import type { Map3d } from "../api/types";
import { bytes, centimetres, moment, percent, way } from "../ui/format";
import { Reasons } from "../ui/Reasons";
import css from "./runs.module.css";

const NAMES: Record<string, string> = { "map.ndt": "NDT map", "cloud.laz": "Cloud, LAZ", "cloud.pcd": "Cloud, PCD", "report.json": "Report" };

/** What a map is good for, and its files. */
export function Map3dResult({ siteId, map }: { siteId: string; map: Map3d }) {
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
      <div className={css.downloads}>
        {map.files.map((file) => (
          <Button key={file.name} size="md" component="a" href={`${url}/files/${file.name}`} download variant="default" leftSection={<IconDownload size={18} />}>
            {NAMES[file.name] ?? file.name}, {bytes(file.size_bytes)}
          </Button>
        ))}
        <ThrowAway url={url} runId={map.run_id} />
      </div>
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

function ThrowAway({ url, runId }: { url: string; runId: string }) {
  const [asked, setAsked] = useState(false);
  const client = useQueryClient();
  const erase = useMutation({
    mutationFn: () => remove(url),
    onSuccess: () =>
      Promise.all([client.invalidateQueries({ queryKey: ["map3d", runId] }), client.invalidateQueries({ queryKey: ["maps3d"] })]),
    onSettled: () => setAsked(false),
  });
  return (
    <>
      <Button size="md" variant="default" color="red" leftSection={<IconTrash size={18} />} onClick={() => setAsked(true)}>
        Throw away
      </Button>
      {erase.error && <Reasons reasons={sentences(erase.error)} />}
      <Modal opened={asked} onClose={() => setAsked(false)} title={<b>Throw this 3D map away?</b>}>
        <p>Its files are deleted. The run stays, and the map can be made of it again.</p>
        <Group grow>
          <Button size="md" variant="default" onClick={() => setAsked(false)} data-autofocus>
            Keep it
          </Button>
          <Button size="md" color="red" loading={erase.isPending} onClick={() => erase.mutate()}>
            Throw it away
          </Button>
        </Group>
      </Modal>
    </>
  );
}
