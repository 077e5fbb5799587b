import { Map as OlMap, View } from "ol";
import { ScaleLine, Zoom } from "ol/control";
import { type ReactNode, createContext, useContext, useEffect, useRef, useState } from "react";

import css from "./map.module.css";

const MapContext = createContext<OlMap | null>(null);

/** The map above this component. Layers are components that put themselves on it and draw nothing else. */
export function useMap(): OlMap {
  const map = useContext(MapContext);
  if (!map) throw new Error("MapView is missing above this component");
  return map;
}

const MAX_ZOOM = 24;

export function MapView({ children, className = "" }: { children: ReactNode; className?: string }) {
  const target = useRef<HTMLDivElement>(null);
  const [map, setMap] = useState<OlMap | null>(null);
  useEffect(() => {
    const created = newMap(target.current!);
    setMap(created);
    return () => created.setTarget(undefined);
  }, []);
  return (
    <div className={`${css.view} ${className}`}>
      <div ref={target} className={css.target} tabIndex={0} aria-label="Map" />
      {map && <MapContext.Provider value={map}>{children}</MapContext.Provider>}
    </div>
  );
}

function newMap(target: HTMLElement): OlMap {
  return new OlMap({
    target,
    controls: [new Zoom({ zoomInTipLabel: "Closer", zoomOutTipLabel: "Farther" }), new ScaleLine({ units: "metric", minWidth: 56 })],
    view: new View({ center: [0, 0], zoom: 2, maxZoom: MAX_ZOOM, enableRotation: false }),
    moveTolerance: 6,
  });
}
