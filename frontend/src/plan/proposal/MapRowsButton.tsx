import { Button, FileButton } from "@mantine/core";
import { IconGridDots } from "@tabler/icons-react";
import { useState } from "react";

import { ImportProgress } from "../imports/ImportProgress";

/** Sends a 3D map; what is found in it is proposed, nothing is changed. */
export function MapRowsButton({ siteId }: { siteId: string }) {
  const [file, setFile] = useState<File | null>(null);
  return (
    <>
      <FileButton accept=".laz,.las,.pcd,.ply" onChange={setFile}>
        {(props) => (
          <Button {...props} variant="default" fullWidth justify="flex-start" leftSection={<IconGridDots size={22} />}>
            Rows from a 3D map …
          </Button>
        )}
      </FileButton>
      {file && <ImportProgress file={file} path={`/api/sites/${siteId}/found-rows`} onClose={() => setFile(null)} />}
    </>
  );
}
