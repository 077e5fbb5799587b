import type { RowProposal, SiteMap } from "../../api/types";

/** The site with what was found in a 3D map. Ids that were given to something drawn meanwhile are changed. */
export function withFound(site: SiteMap, found: RowProposal): SiteMap {
  const taken = new Set([...site.rows, ...site.lanes, ...site.zones].map(({ id }) => id));
  const free = <T extends { id: string }>(item: T): T => {
    let id = item.id;
    for (let n = 2; taken.has(id); n++) id = `${item.id}-${n}`;
    taken.add(id);
    return { ...item, id };
  };
  return {
    ...site,
    rows: [...site.rows, ...found.rows.map(free)],
    lanes: [...site.lanes, ...found.lanes.map(free)],
    zones: [...site.zones, ...found.zones.map(free)],
    plants: [...site.plants, ...found.plants],
  };
}

/** What a proposal would add, as a site of its own. */
export const foundAlone = (site: SiteMap, { rows, lanes, zones, plants }: RowProposal): SiteMap => ({ ...site, warehouse: null, rows, lanes, zones, plants });

const several = (count: number, one: string, many: string) => `${count} ${count === 1 ? one : many}`;

/** As people say it: "3 rows, 3 lanes and 2 headlands". */
export function foundInWords({ rows, lanes, zones }: RowProposal): string {
  const headlands = zones.filter(({ kind }) => kind === "headland").length;
  const rest = zones.length - headlands;
  const parts = [several(rows.length, "row", "rows"), several(lanes.length, "lane", "lanes"), several(headlands, "headland", "headlands")];
  if (rest > 0) parts.push(several(rest, "keep-out zone", "keep-out zones"));
  return `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
}
