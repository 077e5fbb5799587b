import { Circle, Fill, Stroke, Style } from "ol/style";

const AMBER = "#ffb300";

export const SKETCH_STYLE = [
  new Style({ stroke: new Stroke({ color: "rgba(0,0,0,0.6)", width: 6 }), fill: new Fill({ color: "rgba(255,179,0,0.2)" }) }),
  new Style({
    stroke: new Stroke({ color: AMBER, width: 3.5 }),
    image: new Circle({ radius: 8, fill: new Fill({ color: AMBER }), stroke: new Stroke({ color: "#fff", width: 2.5 }) }),
  }),
];

export const VERTEX_STYLE = new Style({
  image: new Circle({ radius: 11, fill: new Fill({ color: "rgba(255,255,255,0.95)" }), stroke: new Stroke({ color: AMBER, width: 4 }) }),
});
