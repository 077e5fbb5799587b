import { FileButton, Menu } from "@mantine/core";
import { IconDownload, IconFileImport, IconTable, IconTrash } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";
import type { ReactNode } from "react";

import { trunksQuery } from "../api/queries";
import { MoreButton } from "../ui/MoreButton";
import { useTrunkFile } from "./useTrunkFile";

interface Props {
  siteId: string;
  onDeleted: () => void;
  /** Items that come first. */
  children?: ReactNode;
}

/** The whole map of trunks: taken home, brought back, thrown away. */
export function TrunkMenu({ siteId, onDeleted, children }: Props) {
  const count = useQuery(trunksQuery(siteId)).data?.trunks.length ?? 0;
  const { load, clear } = useTrunkFile(siteId, onDeleted);
  const askLoad = (file: File | null) => {
    if (file && (count === 0 || window.confirm(`Put this file in the place of the ${count} trunks on the map?`))) load.mutate(file);
  };
  const askClear = () => window.confirm(`Delete all ${count} trunks? Export them first if you may need them again.`) && clear.mutate();
  const path = `/api/sites/${siteId}/trunks`;
  return (
    <MoreButton label="More for trunks" loading={load.isPending || clear.isPending}>
      {children}
      {count > 0 && (
        <>
          <Menu.Item component="a" href={`${path}/geojson`} download leftSection={<IconDownload size={20} />}>
            Export all as GeoJSON
          </Menu.Item>
          <Menu.Item component="a" href={`${path}/csv`} download leftSection={<IconTable size={20} />}>
            Export all as CSV
          </Menu.Item>
        </>
      )}
      <FileButton accept=".geojson,.json,application/geo+json" onChange={askLoad}>
        {(props) => (
          <Menu.Item {...props} closeMenuOnClick={false} leftSection={<IconFileImport size={20} />}>
            Import GeoJSON …
          </Menu.Item>
        )}
      </FileButton>
      {count > 0 && (
        <Menu.Item color="red" leftSection={<IconTrash size={20} />} onClick={askClear}>
          Delete all …
        </Menu.Item>
      )}
    </MoreButton>
  );
}
