import { Button, FileButton } from "@mantine/core";
import { IconFileImport, IconPhotoPlus } from "@tabler/icons-react";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";
import { useLocation } from "wouter";

import { post } from "../../api/client";
import type { ImportedSite } from "../../api/types";
import { note } from "../../ui/notify";
import { GeoJsonButton } from "./GeoJsonButton";
import { ImportProgress } from "./ImportProgress";

/** Sends an orthophoto; a new site's page opens when its tiles are ready. */
export function PhotoButton({ path, word }: { path: string; word: string }) {
  const [file, setFile] = useState<File | null>(null);
  return (
    <>
      <FileButton accept=".tif,.tiff,image/tiff" onChange={setFile}>
        {(props) => (
          <Button {...props} variant="default" fullWidth justify="flex-start" leftSection={<IconPhotoPlus size={22} />}>
            {word}
          </Button>
        )}
      </FileButton>
      {file && <ImportProgress file={file} path={path} onClose={() => setFile(null)} />}
    </>
  );
}

/** Makes a new site of a GeoJSON file, and says what in it was taken otherwise than written. */
export function SiteFileButton({ word }: { word: string }) {
  return <GeoJsonButton path="/api/sites/import" word={word} onDone={useNewSite()} />;
}

/** The same for a Lanelet2 map. */
export function LaneletButton({ word }: { word: string }) {
  const onSuccess = useNewSite();
  const load = useMutation({ mutationFn: (file: File) => post<ImportedSite>("/api/sites/import/osm", file), onSuccess });
  return (
    <FileButton accept=".osm,.xml" onChange={(file) => file && load.mutate(file)}>
      {(props) => (
        <Button {...props} variant="default" fullWidth justify="flex-start" loading={load.isPending} leftSection={<IconFileImport size={22} />}>
          {word}
        </Button>
      )}
    </FileButton>
  );
}

/** Opens a site that was made of a file. */
function useNewSite() {
  const client = useQueryClient();
  const [, go] = useLocation();
  return ({ id, notes }: ImportedSite) => {
    if (notes.length) note("Imported, with notes", notes);
    void client.invalidateQueries({ queryKey: ["sites"] });
    go(`/plan/${id}`);
  };
}
