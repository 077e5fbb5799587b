import { ActionIcon, Loader, Paper } from "@mantine/core";
import { IconBox } from "@tabler/icons-react";
import ImageLayer from "ol/layer/Image";
import ImageStatic from "ol/source/ImageStatic";
import { useEffect } from "react";

import type { Map3d, Map3dPicture } from "../../api/types";
import { Reasons } from "../../ui/Reasons";
import { useMap } from "../MapView";
import { Z } from "../layer";
import { HeightLegend } from "./HeightLegend";
import css from "./map3d.module.css";
import type { Map3dView } from "./useMap3dView";

/** The farm's 3D map seen from above, over the orthophoto, with a switch; nothing on a farm that has none. */
export function Map3dLayer({ siteId, view }: { siteId: string; view: Map3dView }) {
  const { maps, shown, map, picture, problems } = view;
  if (maps.length === 0) return null;
  return (
    <>
      <ActionIcon className={css.switch} aria-pressed={shown} onClick={() => view.show(!shown)} aria-label="Show the 3D map" title="Show the 3D map">
        <IconBox size={26} />
      </ActionIcon>
      {shown && map && picture && <Pixels siteId={siteId} map={map} picture={picture} />}
      {shown && (picture || maps.length > 1) && <HeightLegend view={view} />}
      {shown && !picture && <Instead problems={problems} />}
    </>
  );
}

function Pixels({ siteId, map: { run_id, made }, picture }: { siteId: string; map: Map3d; picture: Map3dPicture }) {
  const map = useMap();
  useEffect(() => {
    const url = `/api/sites/${siteId}/maps3d/${run_id}/picture.png?made=${encodeURIComponent(made)}`;
    const source = new ImageStatic({ url, imageExtent: [...picture.bounds_3857], projection: "EPSG:3857" });
    const layer = new ImageLayer({ zIndex: Z.map3d, source });
    map.addLayer(layer);
    return () => void map.removeLayer(layer);
  }, [map, siteId, run_id, made, picture]);
  return null;
}

/** What stands where the map would be. */
function Instead({ problems }: { problems: readonly string[] }) {
  return (
    <Paper className={css.card} shadow="md" p="sm">
      {problems.length > 0 ? (
        <Reasons reasons={problems} tone="warn" />
      ) : (
        <div className={css.drawing} role="status">
          <Loader size="sm" />
          Drawing the 3D map. The first time this takes some seconds.
        </div>
      )}
    </Paper>
  );
}
