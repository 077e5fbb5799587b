import { Button } from "@mantine/core";
import { IconArrowBarLeft, IconArrowBarRight } from "@tabler/icons-react";
import { useState } from "react";

import type { Row, SiteMap } from "../../api/types";
import { repeatRow } from "../editing/edits";
import css from "../plan.module.css";
import { NumberField } from "./NumberField";

/** Draws a whole block from its first row. */
export function RepeatRow({ site, row, onCommit }: { site: SiteMap; row: Row; onCommit: (site: SiteMap) => void }) {
  const [count, setCount] = useState(5);
  const [spacing, setSpacing] = useState(row.width);
  return (
    <fieldset className={css.visit}>
      <legend>Repeat this row</legend>
      <div className={css.pair}>
        <NumberField label="More rows" unit="rows" min={1} max={200} step={1} value={count} onChange={(n) => setCount(Math.round(n))} />
        <NumberField label="Spacing" unit="m" min={0.5} max={20} step={0.1} value={spacing} onChange={setSpacing} />
        <Button variant="light" leftSection={<IconArrowBarLeft size={20} />} onClick={() => onCommit(repeatRow(site, row.id, count, spacing))}>
          To the left
        </Button>
        <Button variant="light" rightSection={<IconArrowBarRight size={20} />} onClick={() => onCommit(repeatRow(site, row.id, count, -spacing))}>
          To the right
        </Button>
      </div>
      <p className={css.quiet}>Left and right as seen from the row’s start (the dot).</p>
    </fieldset>
  );
}
