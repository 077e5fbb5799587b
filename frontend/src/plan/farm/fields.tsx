import { SegmentedControl, TextInput } from "@mantine/core";

import type { Lane, Point, Row, SiteMap, Warehouse, Zone, ZoneKind } from "../../api/types";
import { leadsTo, sharpestRadius } from "../../geo/laneCourse";
import { area, length } from "../../geo/measure";
import { hectares, metres } from "../../ui/format";
import { changeLane, changeRow, changeWarehouse, changeZone } from "../editing/edits";
import css from "../plan.module.css";
import { NumberField } from "./NumberField";
import { RepeatRow } from "./RepeatRow";

type Commit = (site: SiteMap) => void;

const WIDTH = { unit: "m", min: 0.5, max: 20, step: 0.1 };
const SPEED = { unit: "m/s", min: 0.1, max: 2, step: 0.1 };
const SPACING = { unit: "m", min: 0.2, max: 50, step: 0.1 };
const DEG = 180 / Math.PI;

function NameField({ value, onChange }: { value: string; onChange: (name: string) => void }) {
  return <TextInput label="Name" value={value} maxLength={100} onChange={(event) => onChange(event.currentTarget.value)} />;
}

/** What is derived from a line's points. */
function Course({ points }: { points: readonly Point[] }) {
  const radius = sharpestRadius(points);
  return (
    <dl className={css.facts}>
      <dt>Length</dt>
      <dd>{metres(length(points))}</dd>
      <dt>Leads to the</dt>
      <dd>{leadsTo(points) ?? "–, it comes back"}</dd>
      <dt>Sharpest bend</dt>
      <dd>{radius === null ? "none, straight" : `radius ${metres(radius)}`}</dd>
    </dl>
  );
}

export function WarehouseFields({ site, warehouse, onCommit }: { site: SiteMap; warehouse: Warehouse; onCommit: Commit }) {
  const change = (part: Partial<Warehouse>) => onCommit(changeWarehouse(site, part));
  return (
    <>
      <NameField value={warehouse.name} onChange={(name) => change({ name })} />
      <NumberField steps label="Parked looking (0° east, 90° north)" unit="°" min={-180} max={180} step={5} value={warehouse.yaw * DEG} onChange={(deg) => change({ yaw: deg / DEG })} />
    </>
  );
}

export function LaneFields({ site, lane, onCommit }: { site: SiteMap; lane: Lane; onCommit: Commit }) {
  const change = (part: Partial<Lane>) => onCommit(changeLane(site, lane.id, part));
  return (
    <>
      <NameField value={lane.name} onChange={(name) => change({ name })} />
      <div className={css.pair}>
        <NumberField label="Width" {...WIDTH} value={lane.width} onChange={(width) => change({ width })} />
        <NumberField label="Speed" {...SPEED} value={lane.speed} onChange={(speed) => change({ speed })} />
      </div>
      <Course points={lane.points} />
      <p className={css.quiet}>Drag a point to move it, drag the line to add one, double-tap a point to remove it.</p>
    </>
  );
}

export function RowFields({ site, row, onCommit }: { site: SiteMap; row: Row; onCommit: Commit }) {
  const change = (part: Partial<Row>) => onCommit(changeRow(site, row.id, part));
  return (
    <>
      <NameField value={row.name} onChange={(name) => change({ name })} />
      <div className={css.pair}>
        <NumberField label="Width between plants" {...WIDTH} value={row.width} onChange={(width) => change({ width })} />
        <NumberField label="Speed" {...SPEED} value={row.speed} onChange={(speed) => change({ speed })} />
        <NumberField label="Post every" {...SPACING} value={row.post_spacing} onChange={(post_spacing) => change({ post_spacing })} />
        <NumberField label="Plant every" {...SPACING} value={row.plant_spacing} onChange={(plant_spacing) => change({ plant_spacing })} />
      </div>
      <Course points={[row.start, row.end]} />
      <p className={css.quiet}>Drag its ends to fit the alley.</p>
      <RepeatRow site={site} row={row} onCommit={onCommit} />
    </>
  );
}

const ZONE_KINDS: { value: ZoneKind; label: string }[] = [
  { value: "keep_in", label: "Keep in" },
  { value: "keep_out", label: "Keep out" },
  { value: "headland", label: "Headland" },
];

export function ZoneFields({ site, zone, onCommit }: { site: SiteMap; zone: Zone; onCommit: Commit }) {
  const change = (part: Partial<Zone>) => onCommit(changeZone(site, zone.id, part));
  return (
    <>
      <NameField value={zone.name} onChange={(name) => change({ name })} />
      <SegmentedControl fullWidth value={zone.kind} onChange={(kind) => change({ kind: kind as ZoneKind })} data={ZONE_KINDS} />
      <p className={css.quiet}>Area {hectares(area(zone.polygon))}.</p>
    </>
  );
}
