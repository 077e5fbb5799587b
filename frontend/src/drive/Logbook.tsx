import { SegmentedControl } from "@mantine/core";
import { useState } from "react";

import { SwitchList } from "../plots/SwitchList";
import { LivePlots } from "./LivePlots";
import css from "./drive.module.css";
import { useHistorySnapshot } from "./useHistorySnapshot";

/** The last minutes as plots, or the switches of the run so far. */
export function Logbook() {
  const [tab, setTab] = useState("plots");
  const { samples, switches, startNs } = useHistorySnapshot();
  return (
    <section className={css.logbook}>
      <SegmentedControl fullWidth value={tab} onChange={setTab} data={[{ value: "plots", label: "Last minutes" }, { value: "switches", label: `Switches (${switches.length})` }]} />
      {tab === "plots" ? <LivePlots samples={samples} /> : <SwitchList switches={switches} timeOf={(item) => (item.stamp_ns - startNs) / 1e9} />}
    </section>
  );
}
