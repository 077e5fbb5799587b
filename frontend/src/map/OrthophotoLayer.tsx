import TileLayer from "ol/layer/Tile";
import XYZ from "ol/source/XYZ";
import { useEffect } from "react";

import type { OrthophotoInfo } from "../api/types";
import { useMap } from "./MapView";
import { Z } from "./layer";

/** The site's picture, from the station's own tiles. */
export function OrthophotoLayer({ siteId, orthophoto }: { siteId: string; orthophoto: OrthophotoInfo }) {
  const map = useMap();
  const { id, min_zoom, max_zoom, bounds_3857 } = orthophoto;
  const extent = bounds_3857.join();
  useEffect(() => {
    const layer = new TileLayer({
      zIndex: Z.photo,
      extent: extent.split(",").map(Number),
      source: new XYZ({
        url: `/api/sites/${siteId}/tiles/{z}/{x}/{y}.png?photo=${id}`,
        minZoom: min_zoom,
        maxZoom: max_zoom,
        transition: 0,
      }),
    });
    map.addLayer(layer);
    return () => void map.removeLayer(layer);
  }, [map, siteId, id, min_zoom, max_zoom, extent]);
  return null;
}
