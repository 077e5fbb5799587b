import type { Map as OlMap } from "ol";
import VectorLayer from "ol/layer/Vector";
import VectorSource from "ol/source/Vector";
import type { StyleLike } from "ol/style/Style";
import { useEffect, useMemo } from "react";

import { useMap } from "./MapView";

/** What lies above what. */
export const Z = { photo: 0, map3d: 5, site: 10, plan: 20, trunks: 25, driven: 30, edit: 40, robot: 50, ghosts: 55 } as const;

/** A vector layer that lives as long as its component. With `declutter`, labels never cover each other. */
export function useVectorLayer(zIndex: number, style?: StyleLike, declutter = false): VectorSource {
  const map: OlMap = useMap();
  const layer = useMemo(
    () => new VectorLayer({ source: new VectorSource(), zIndex, style, updateWhileAnimating: true, updateWhileInteracting: true, declutter }),
    [zIndex, style, declutter],
  );
  useEffect(() => {
    map.addLayer(layer);
    return () => void map.removeLayer(layer);
  }, [map, layer]);
  return layer.getSource()!;
}
