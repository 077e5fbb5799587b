import { Menu, Select } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import { useLocation } from "wouter";

import { sitesQuery } from "../../api/queries";
import type { SiteDocument } from "../../api/types";
import { MoreButton } from "../../ui/MoreButton";
import css from "../plan.module.css";
import type { SiteEditing } from "../useSiteEditor";
import { DeleteSite } from "./DeleteSite";
import { NewSite } from "./NewSite";
import { SimulateButton } from "./SimulateButton";

type Dialog = "new" | "delete" | null;

/** Which farm, and what can be done with it as a whole. */
export function SiteHeader({ document, editing }: { document: SiteDocument; editing: SiteEditing }) {
  const [, go] = useLocation();
  const [dialog, setDialog] = useState<Dialog>(null);
  const sites = useQuery(sitesQuery).data ?? [document];
  const data = sites.map(({ id, name }) => ({ value: id, label: name }));
  return (
    <>
      <div className={css.header}>
        <Select className={css.grow} size="lg" aria-label="Farm" data={data} value={document.id} onChange={(id) => id && go(`/plan/${id}`)} />
        <MoreButton size={50} label="More for this farm">
          <Menu.Item onClick={() => setDialog("new")}>New farm …</Menu.Item>
          <Menu.Item component="a" href={`/api/sites/${document.id}/geojson`} download>
            Export as GeoJSON
          </Menu.Item>
          <Menu.Item component="a" href={`/api/sites/${document.id}/osm`} download>
            Export as Lanelet2 (OSM)
          </Menu.Item>
          <Menu.Item color="red" onClick={() => setDialog("delete")}>
            Delete this farm …
          </Menu.Item>
        </MoreButton>
      </div>
      <SimulateButton siteId={document.id} editing={editing} />
      <NewSite opened={dialog === "new"} onClose={() => setDialog(null)} />
      <DeleteSite opened={dialog === "delete"} onClose={() => setDialog(null)} document={document} />
    </>
  );
}
