import { Modal, Stack } from "@mantine/core";

import { GeoJsonButton, PhotoButton } from "../imports/ImportButtons";

export function NewSite({ opened, onClose }: { opened: boolean; onClose: () => void }) {
  return (
    <Modal opened={opened} onClose={onClose} title={<b>New farm</b>}>
      <Stack>
        <PhotoButton path="/api/orthophotos" word="From an orthophoto (GeoTIFF)" />
        <GeoJsonButton word="From GeoJSON" />
      </Stack>
    </Modal>
  );
}
