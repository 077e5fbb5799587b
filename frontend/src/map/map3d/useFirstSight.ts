import { useEffect, useState } from "react";

/** What FitTo shall show: on a farm of which nothing else is known, the 3D map once it has arrived, and only once. */
export function useFirstSight(siteId: string, bare: boolean, arrived: boolean): string {
  const [onMap, setOnMap] = useState(false);
  useEffect(() => {
    if (bare && arrived) setOnMap(true);
  }, [arrived]);
  return onMap ? `${siteId}, 3D map` : siteId;
}
