import { Button, FileButton } from "@mantine/core";
import { IconFileImport, IconPhotoPlus } from "@tabler/icons-react";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";
import { useLocation } from "wouter";

import { post } from "../../api/client";
import type { SiteDocument } from "../../api/types";
import { ImportProgress } from "./ImportProgress";
import { readJson } from "./readJson";

const VARIANT = { variant: "default", fullWidth: true, justify: "flex-start" } as const;

/** Sends an orthophoto; a new site's page opens when its tiles are ready. */
export function PhotoButton({ path, word }: { path: string; word: string }) {
  const [file, setFile] = useState<File | null>(null);
  return (
    <>
      <FileButton accept=".tif,.tiff,image/tiff" onChange={setFile}>
        {(props) => (
          <Button {...props} {...VARIANT} leftSection={<IconPhotoPlus size={22} />}>
            {word}
          </Button>
        )}
      </FileButton>
      {file && <ImportProgress file={file} path={path} onClose={() => setFile(null)} />}
    </>
  );
}

/** Makes a new site of a GeoJSON file. */
export function GeoJsonButton({ word }: { word: string }) {
  const client = useQueryClient();
  const [, go] = useLocation();
  const load = useMutation({
    mutationFn: async (file: File) => post<SiteDocument>("/api/sites/import", await readJson(file)),
    onSuccess: ({ id }) => {
      void client.invalidateQueries({ queryKey: ["sites"] });
      go(`/plan/${id}`);
    },
  });
  return (
    <FileButton accept=".geojson,.json,application/geo+json" onChange={(file) => file && load.mutate(file)}>
      {(props) => (
        <Button {...props} {...VARIANT} loading={load.isPending} leftSection={<IconFileImport size={22} />}>
          {word}
        </Button>
      )}
    </FileButton>
  );
}
