import { Modal, Stack } from "@mantine/core";

import { LaneletButton, PhotoButton, SiteFileButton } from "../imports/ImportButtons";

export function NewSite({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  return (
    <Modal opened={opened} onClose={onClose} title={<b>New farm</b>}>
      <Stack>
        <PhotoButton path="/api/orthophotos" word="From an orthophoto (GeoTIFF)" />
        <SiteFileButton word="From GeoJSON" />
        <LaneletButton word="From Lanelet2 (OSM)" />
      </Stack>
    </Modal>
  );
}
