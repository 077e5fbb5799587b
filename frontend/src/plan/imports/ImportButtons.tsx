import { Button, FileButton } from "@mantine/core";
import { IconPhotoPlus } from "@tabler/icons-react";
import { useQueryClient } from "@tanstack/react-query";
import { useState } from "react";
import { useLocation } from "wouter";

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
  const client = useQueryClient();
  const [, go] = useLocation();
  const show = ({ id, notes }: ImportedSite) => {
    if (notes.length) note("Imported, with notes", notes);
    void client.invalidateQueries({ queryKey: ["sites"] });
    go(`/plan/${id}`);
  };
  return <GeoJsonButton path="/api/sites/import" word={word} onDone={show} />;
}
