import { Button } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";

import type { SiteMap } from "../../api/types";
import type { ItemRef } from "../../map/siteFeatures";
import { Card } from "../../ui/Card";
import { removeItem } from "../editing/edits";
import css from "../plan.module.css";
import { LaneFields, RowFields, WarehouseFields, ZoneFields } from "./fields";

interface Props {
  site: SiteMap;
  selected: ItemRef;
  onCommit: (site: SiteMap) => void;
  onSelect: (ref: ItemRef | null) => void;
}

const TITLES = { warehouse: "Warehouse", lane: "Lane", row: "Row", zone: "Zone" } as const;

/** The numbers of what is selected. */
export function ItemPanel({ site, selected, onCommit, onSelect }: Props) {
  const erase = () => {
    onCommit(removeItem(site, selected));
    onSelect(null);
  };
  return (
    <Card title={TITLES[selected.kind]}>
      <div className={css.stack}>
        <Fields site={site} selected={selected} onCommit={onCommit} />
        <div className={css.pair}>
          <Button color="red" variant="light" leftSection={<IconTrash size={20} />} onClick={erase}>
            Delete
          </Button>
          <Button variant="default" onClick={() => onSelect(null)}>
            Close
          </Button>
        </div>
      </div>
    </Card>
  );
}

function Fields({ site, selected, onCommit }: Omit<Props, "onSelect">) {
  const of = <T extends { id: string }>(items: T[]) => items.find(({ id }) => id === selected.id);
  const [lane, row, zone] = [of(site.lanes), of(site.rows), of(site.zones)];
  if (selected.kind === "lane" && lane) return <LaneFields site={site} lane={lane} onCommit={onCommit} />;
  if (selected.kind === "row" && row) return <RowFields key={row.id} site={site} row={row} onCommit={onCommit} />;
  if (selected.kind === "zone" && zone) return <ZoneFields site={site} zone={zone} onCommit={onCommit} />;
  return selected.kind === "warehouse" && site.warehouse ? <WarehouseFields site={site} warehouse={site.warehouse} onCommit={onCommit} /> : null;
}
