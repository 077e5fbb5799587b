import { Button, FileButton } from "@mantine/core";
import { IconFileImport } from "@tabler/icons-react";
import { useMutation } from "@tanstack/react-query";

import { post } from "../../api/client";
import { readJson } from "../../api/readJson";

interface Props<T> {
  /** Where the file's content is sent. */
  path: string;
  word: string;
  onDone: (made: T) => void;
}

/** Sends a GeoJSON file; the station answers with what it made of it. */
export function GeoJsonButton<T>({ path, word, onDone }: Props<T>) {
  const load = useMutation({ mutationFn: async (file: File) => post<T>(path, await readJson(file)), onSuccess: onDone });
  return (
    <FileButton accept=".geojson,.json,application/geo+json" onChange={(file) => file && load.mutate(file)}>
      {(props) => (
        <Button {...props} variant="default" fullWidth justify="flex-start" loading={load.isPending} leftSection={<IconFileImport size={22} />}>
          {word}
        </Button>
      )}
    </FileButton>
  );
}
