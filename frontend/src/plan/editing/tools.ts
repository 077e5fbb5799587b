import type { ZoneKind } from "../../api/types";

export type Tool = "select" | "warehouse" | "lane" | "row" | ZoneKind;

export const TOOLS: { name: Tool; word: string; hint: string }[] = [
  { name: "select", word: "Select", hint: "" },
  { name: "warehouse", word: "Warehouse", hint: "Tap where the robot parks, then where it looks." },
  { name: "lane", word: "Lane", hint: "Tap along the road, then press Done." },
  { name: "row", word: "Row", hint: "Tap one end of the alley between the plants, then the other." },
  { name: "keep_in", word: "Keep in", hint: "Tap the corners of the area the robot must stay in, then press Done." },
  { name: "keep_out", word: "Keep out", hint: "Tap the corners of the area the robot must not enter, then press Done." },
  { name: "headland", word: "Headland", hint: "Tap the corners of the open ground where the robot may turn, then press Done." },
];

export const isZone = (tool: Tool): tool is ZoneKind => tool === "keep_in" || tool === "keep_out" || tool === "headland";
