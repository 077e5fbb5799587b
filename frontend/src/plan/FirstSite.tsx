import { Group } from "@mantine/core";
import { IconMapPinPlus } from "@tabler/icons-react";

import { EmptyState } from "../ui/EmptyState";
import { LaneletButton, PhotoButton, SiteFileButton } from "./imports/ImportButtons";

export function FirstSite() {
  const actions = (
    <Group justify="center">
      <PhotoButton path="/api/orthophotos" word="Import an orthophoto (GeoTIFF)" />
      <SiteFileButton word="Import GeoJSON" />
      <LaneletButton word="Import Lanelet2 (OSM)" />
    </Group>
  );
  return (
    <EmptyState icon={IconMapPinPlus} title="No farm yet" action={actions}>
      Begin with an orthophoto of your farm, as a drone or a land survey office delivers it. Then draw the warehouse, the roads and the rows on it.
    </EmptyState>
  );
}
