import { Menu, Paper } from "@mantine/core";
import { IconCheck } from "@tabler/icons-react";

import { MoreButton } from "../../ui/MoreButton";
import css from "./map3d.module.css";
import { gradient, mapWords } from "./shownMap";
import type { Map3dView } from "./useMap3dView";

/** What the colours mean, and the farm's other maps where it has several. */
export function HeightLegend({ view: { maps, map, picture, choose } }: { view: Map3dView }) {
  return (
    <Paper className={css.legend} shadow="md" role="group" aria-label="Height above the ground">
      {maps.length > 1 && (
        <MoreButton label="Which 3D map">
          <Menu.Label>3D maps of this farm</Menu.Label>
          {maps.map((one) => (
            <Menu.Item key={one.run_id} leftSection={<IconCheck size={20} visibility={one === map ? "visible" : "hidden"} />} onClick={() => choose(one.run_id)}>
              {mapWords(one)}
              {one.georeferenced ? "" : ", no place on the Earth"}
            </Menu.Item>
          ))}
        </MoreButton>
      )}
      {picture && (
        <div className={css.scale}>
          <div className={css.colours} style={{ background: gradient(picture.legend) }} />
          <div className={css.marks}>
            <span>{top(picture.legend.at(-1)!.height)}</span>
            <span>{picture.legend.at(-1)!.height / 2} m</span>
            <span>ground</span>
          </div>
        </div>
      )}
    </Paper>
  );
}

const top = (height: number) => `≥ ${height} m`;
