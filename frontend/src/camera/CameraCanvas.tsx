import { useCallback } from "react";

import type { CameraView } from "../api/types";
import { type Layers, overlay } from "./overlay";
import { type Feed, PictureCanvas } from "./PictureCanvas";

/** The row worker's pictures with the layers that are on. */
export function CameraCanvas({ feed, layers }: { feed: Feed<CameraView>; layers: Layers }) {
  const shapes = useCallback((view: CameraView) => overlay(view, layers), [layers]);
  return <PictureCanvas feed={feed} shapes={shapes} />;
}
