import { useEffect, useMemo } from "react";

import type { RowProposal, SiteMap } from "../../api/types";
import type { SiteFrame } from "../../geo/siteFrame";
import { useMap } from "../../map/MapView";
import { firstExtent } from "../../map/fit";
import { Z, useVectorLayer } from "../../map/layer";
import { siteFeatures } from "../../map/siteFeatures";
import { siteStyle } from "../../map/siteStyle";
import { foundAlone } from "./withFound";

/** Everything of a proposal looks chosen: it is not part of the farm yet. */
const style = siteStyle(() => true);

/** What was found in a 3D map, over the farm as drawn; the view goes there once. */
export function ProposalLayer({ site, found, frame }: { site: SiteMap; found: RowProposal; frame: SiteFrame }) {
  const source = useVectorLayer(Z.plan, style, true);
  const alone = useMemo(() => foundAlone(site, found), [site, found]);
  useEffect(() => {
    source.clear(true);
    source.addFeatures(siteFeatures(alone, frame));
  }, [source, alone, frame]);
  const map = useMap();
  useEffect(() => {
    if (found.rows.length > 0) map.getView().fit(firstExtent(alone, null, frame), { padding: [56, 104, 56, 104], maxZoom: 21 });
  }, [map, found]);
  return null;
}
