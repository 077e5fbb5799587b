import { Collection, type Feature, type Map as OlMap, type MapBrowserEvent } from "ol";
import type BaseEvent from "ol/events/Event";
import { altKeyOnly, singleClick } from "ol/events/condition";
import { type Geometry, LineString } from "ol/geom";
import { Draw, Modify, Snap } from "ol/interaction";
import type VectorSource from "ol/source/Vector";

import type { Point, SiteMap } from "../../api/types";
import type { SiteFrame } from "../../geo/siteFrame";
import { type ItemRef, refOf, sameItem, siteFeatures } from "../../map/siteFeatures";
import { SKETCH_STYLE, VERTEX_STYLE } from "./editStyle";
import { MeasureTip, corners } from "./measureTip";
import { type Tool, isZone } from "./tools";

export interface EditorEvents {
  onSelect: (ref: ItemRef | null) => void;
  onDrawn: (tool: Tool, points: Point[]) => void;
  onReshaped: (ref: ItemRef, points: Point[]) => void;
}

const TOUCH_PX = 14;
const TWO_POINTS: ReadonlySet<Tool> = new Set(["row", "warehouse"]);

/** The map's drawing table: shows the site, draws, selects and drags, and tells what was done in `map` metres. */
export class SiteEditor {
  private readonly chosen = new Collection<Feature>();
  private readonly modify: Modify;
  private readonly snap: Snap;
  private readonly tip: MeasureTip;
  private draw: Draw | null = null;
  private selected: ItemRef | null = null;

  constructor(
    private readonly map: OlMap,
    private readonly source: VectorSource,
    private readonly frame: SiteFrame,
    private readonly events: EditorEvents,
  ) {
    this.tip = new MeasureTip(map, frame);
    this.modify = this.newModify();
    this.snap = new Snap({ source, pixelTolerance: 10 });
    map.addInteraction(this.modify);
    map.addInteraction(this.snap);
    map.on("singleclick", this.onClick);
  }

  setSite(site: SiteMap): void {
    this.source.clear(true);
    this.source.addFeatures(siteFeatures(site, this.frame));
    this.showSelected();
  }

  setSelected(ref: ItemRef | null): void {
    this.selected = ref;
    this.showSelected();
  }

  setTool(tool: Tool): void {
    this.endDrawing();
    this.modify.setActive(tool === "select");
    if (tool === "select") return;
    this.draw = this.newDraw(tool);
    // Snap must see the pointer before the drawing does: the interaction added last comes first.
    this.map.removeInteraction(this.snap);
    this.map.addInteraction(this.draw);
    this.map.addInteraction(this.snap);
  }

  finish = (): void => this.draw?.finishDrawing() as void;
  removeLastPoint = (): void => this.draw?.removeLastPoint() as void;

  close(): void {
    this.endDrawing();
    this.map.removeInteraction(this.modify);
    this.map.removeInteraction(this.snap);
    this.map.un("singleclick", this.onClick);
    this.tip.close();
  }

  private newModify(): Modify {
    const modify = new Modify({
      features: this.chosen,
      style: VERTEX_STYLE,
      pixelTolerance: TOUCH_PX,
      insertVertexCondition: () => this.selected?.kind === "lane" || this.selected?.kind === "zone",
      deleteCondition: (event) => event.type === "dblclick" || (altKeyOnly(event) && singleClick(event)),
    });
    modify.on("modifyend", () => this.onModified());
    modify.on("modifystart", () => this.chosen.item(0)?.getGeometry()?.on("change", this.onShape));
    return modify;
  }

  private newDraw(tool: Tool): Draw {
    const draw = new Draw({
      type: isZone(tool) ? "Polygon" : "LineString",
      maxPoints: TWO_POINTS.has(tool) ? 2 : undefined,
      style: SKETCH_STYLE,
      snapTolerance: TOUCH_PX,
      stopClick: true,
    });
    draw.on("drawstart", (event) => event.feature.getGeometry()!.on("change", this.onShape));
    draw.on("drawabort", this.tip.hide);
    draw.on("drawend", (event) => {
      this.tip.hide();
      this.events.onDrawn(tool, this.metres(event.feature.getGeometry()!));
    });
    return draw;
  }

  private readonly onShape = (event: BaseEvent) => this.tip.show(event.target as Geometry);

  private onModified(): void {
    this.tip.hide();
    const feature = this.chosen.item(0);
    const ref = feature && refOf(feature);
    if (ref) this.events.onReshaped(ref, this.metres(feature.getGeometry()!));
  }

  private readonly onClick = (event: MapBrowserEvent) => {
    if (!this.draw) this.events.onSelect(itemAt(this.map, this.source, event.pixel));
  };

  private metres(geometry: Geometry): Point[] {
    return corners(geometry).map((corner) => this.frame.fromScreen(corner));
  }

  private showSelected(): void {
    this.chosen.clear();
    const feature = this.source.getFeatures().find((candidate) => sameItem(refOf(candidate), this.selected));
    if (feature && this.selected) this.chosen.push(feature);
    this.source.changed();
  }

  private endDrawing(): void {
    this.tip.hide();
    if (this.draw) this.map.removeInteraction(this.draw);
    this.draw = null;
  }
}

/** What lies under a finger: lines come before the areas that they run through. */
export function itemAt(map: OlMap, source: VectorSource, pixel: number[]): ItemRef | null {
  const found: Feature[] = [];
  map.forEachFeatureAtPixel(
    pixel,
    (feature) => {
      if (source.hasFeature(feature as Feature)) found.push(feature as Feature);
    },
    { hitTolerance: TOUCH_PX / 2 },
  );
  const line = found.find((feature) => feature.getGeometry() instanceof LineString);
  const first = line ?? found[0];
  return first ? refOf(first) : null;
}
