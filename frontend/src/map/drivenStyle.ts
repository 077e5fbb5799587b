import { Stroke, Style } from "ol/style";

const CASING = new Style({ stroke: new Stroke({ color: "rgba(0,0,0,0.75)", width: 4 }) });
const LINE = new Style({ stroke: new Stroke({ color: "#ffd43b", width: 2.2 }) });

export const DRIVEN_STYLE = () => [CASING, LINE];
