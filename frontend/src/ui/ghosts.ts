import type { Ghost } from "../api/types";
import { centimetres } from "./format";

type Source = Ghost["source"];

const GHOST_WORDS: Record<Source, string> = { gnss: "GNSS", odometry: "Odometry", rows: "Rows", map: "3D map" };

export const GHOST_COLORS: Record<Source, string> = { gnss: "#e03131", odometry: "#868e96", rows: "#9c36b5", map: "#1098ad" };

/** "3D map 4 cm". */
export const ghostWords = ({ source, apart }: Ghost) => `${GHOST_WORDS[source]} ${centimetres(apart)}`;

/** "GNSS 2 cm, odometry 31 cm": how far each is from the driven pose. */
export const apartWords = (ghosts: readonly Ghost[]) => ghosts.map(ghostWords).join(", ");
