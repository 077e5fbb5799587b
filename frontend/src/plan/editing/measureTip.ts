import { type Map as OlMap, Overlay } from "ol";
import { type Geometry, LineString, Polygon } from "ol/geom";

import type { Point } from "../../api/types";
import { area, distance, length } from "../../geo/measure";
import type { SiteFrame } from "../../geo/siteFrame";
import mapCss from "../../map/map.module.css";
import { hectares, metres } from "../../ui/format";

/** Coordinates of a drawn shape; a polygon's closing point is left out. */
export function corners(geometry: Geometry): number[][] {
  if (geometry instanceof LineString) return geometry.getCoordinates();
  return geometry instanceof Polygon ? (geometry.getCoordinates()[0] ?? []).slice(0, -1) : [];
}

/** Length of the last stretch and of the whole, and a polygon's area, all on the ground and not on the screen. */
export function measureWords(points: Point[], closed: boolean): string {
  const last = points.length > 1 ? distance(points.at(-2)!, points.at(-1)!) : 0;
  const parts = [metres(last)];
  if (points.length > 2) parts.push(closed ? hectares(area(points)) : `whole ${metres(length(points))}`);
  return parts.join(" · ");
}

/** A small label at the tip of what is being drawn or dragged. */
export class MeasureTip {
  private readonly element = document.createElement("div");
  private readonly overlay: Overlay;

  constructor(
    private readonly map: OlMap,
    private readonly frame: SiteFrame,
  ) {
    this.element.className = mapCss.measure ?? "";
    this.overlay = new Overlay({ element: this.element, offset: [18, -14], stopEvent: false });
    map.addOverlay(this.overlay);
  }

  show(geometry: Geometry): void {
    const screen = corners(geometry);
    if (screen.length < 2) return;
    this.element.textContent = measureWords(screen.map((c) => this.frame.fromScreen(c)), geometry instanceof Polygon);
    this.overlay.setPosition(screen.at(-1));
  }

  hide = (): void => this.overlay.setPosition(undefined);

  close(): void {
    this.map.removeOverlay(this.overlay);
  }
}
