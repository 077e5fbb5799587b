import { useMemo } from "react";

import type { Datum } from "../api/types";
import { SiteFrame } from "../geo/siteFrame";

/** The site's frame; the same object as long as the datum is the same place. */
export function useSiteFrame(datum: Datum): SiteFrame {
  const { lat_deg, lon_deg, height_m, frame, corrections } = datum;
  return useMemo(() => new SiteFrame({ lat_deg, lon_deg, height_m, frame, corrections }), [lat_deg, lon_deg, height_m, frame, corrections]);
}
