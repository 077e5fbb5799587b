import { Button } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { IconBox } from "@tabler/icons-react";
import { Link } from "wouter";

import { maps3dQuery } from "../api/queries";
import { moment } from "../ui/format";
import css from "./runs.module.css";

/** The farm's maps of other runs, each a way to its run. */
export function SiteMaps3d({ siteId, runId }: { siteId: string; runId: string }) {
  const others = (useQuery(maps3dQuery(siteId)).data ?? []).filter((map) => map.run_id !== runId);
  if (others.length === 0) return null;
  return (
    <>
      <span>Other 3D maps of this farm</span>
      <div className={css.downloads}>
        {others.map((map) => (
          <Button key={map.run_id} size="md" component={Link} href={`/runs/${map.run_id}`} variant="default" leftSection={<IconBox size={18} />}>
            {moment(map.made)}, {map.hectares.toFixed(2)} ha
          </Button>
        ))}
      </div>
    </>
  );
}
