import { useEffect } from "react";

import type { SiteMap } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { Z, useVectorLayer } from "./layer";
import { siteFeatures } from "./siteFeatures";
import { siteStyle } from "./siteStyle";

const style = siteStyle(() => false);

/** The site as drawn, to look at. */
export function SiteLayer({ site, frame }: { site: SiteMap; frame: SiteFrame }) {
  const source = useVectorLayer(Z.site, style, true);
  useEffect(() => {
    source.clear(true);
    source.addFeatures(siteFeatures(site, frame));
  }, [source, site, frame]);
  return null;
}
