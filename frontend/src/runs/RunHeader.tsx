import { Button } from "@mantine/core";
import { IconArrowLeft, IconDownload } from "@tabler/icons-react";
import { Link } from "wouter";

import type { RunDetail } from "../api/types";
import { bytes, moment } from "../ui/format";
import { Outcome, RunFigures } from "./RunFigures";
import { Map3d } from "./Map3d";
import { MapTrunks } from "./MapTrunks";
import css from "./runs.module.css";

const FORMATS = ["mcap", "csv", "geojson", "gpx"] as const;

/** What it was, how it ended, and its files. */
export function RunHeader({ run }: { run: RunDetail }) {
  return (
    <header className={css.header}>
      <Button component={Link} href="/runs" variant="default" leftSection={<IconArrowLeft size={20} />}>
        Runs
      </Button>
      <div className={css.title}>
        <h1>{run.mission_name}</h1>
        <span>
          {run.site_name} · {moment(run.started)}
        </span>
        {run.reason && <span>{run.reason}</span>}
      </div>
      <Outcome run={run} />
      <RunFigures run={run} full />
      <Downloads run={run} />
      <MapTrunks run={run} />
      <Map3d run={run} />
    </header>
  );
}

function Downloads({ run }: { run: RunDetail }) {
  if (run.log_bytes === null) return <span>No log on disk</span>;
  return (
    <div className={css.downloads}>
      {FORMATS.map((format) => (
        <Button key={format} component="a" href={`/api/runs/${run.id}/download?format=${format}`} download variant="default" leftSection={<IconDownload size={18} />}>
          {format === "mcap" ? `MCAP, ${bytes(run.log_bytes)}` : format === "geojson" ? "GeoJSON" : format.toUpperCase()}
        </Button>
      ))}
    </div>
  );
}
