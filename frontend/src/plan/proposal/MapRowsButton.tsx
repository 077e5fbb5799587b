import { Button } from "@mantine/core";
import { IconGridDots } from "@tabler/icons-react";
import { useState } from "react";

import type { Map3d } from "../../api/types";
import { ImportProgress } from "../imports/ImportProgress";
import { MapRowsDialog } from "./MapRowsDialog";
import { OwnMapProgress } from "./OwnMapProgress";

/** Asks for a 3D map, the farm's own or a file; what is found in it is proposed, nothing is changed. */
export function MapRowsButton({ siteId }: { siteId: string }) {
  const [asking, setAsking] = useState(false);
  const [source, setSource] = useState<Map3d | File | null>(null);
  const take = (chosen: Map3d | File) => {
    setAsking(false);
    setSource(chosen);
  };
  const close = () => setSource(null);
  return (
    <>
      <Button variant="default" fullWidth justify="flex-start" leftSection={<IconGridDots size={22} />} onClick={() => setAsking(true)}>
        Rows from a 3D map …
      </Button>
      {asking && <MapRowsDialog siteId={siteId} onTake={take} onClose={() => setAsking(false)} />}
      {source instanceof File ? (
        <ImportProgress file={source} path={`/api/sites/${siteId}/found-rows`} onClose={close} />
      ) : (
        source && <OwnMapProgress siteId={siteId} map={source} onClose={close} />
      )}
    </>
  );
}
