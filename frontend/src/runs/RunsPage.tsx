import { Button, Loader } from "@mantine/core";
import { IconHistory } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";
import { Link } from "wouter";

import { sentences } from "../api/client";
import { runsQuery } from "../api/queries";
import type { RunDocument } from "../api/types";
import { EmptyState } from "../ui/EmptyState";
import { moment } from "../ui/format";
import { Reasons } from "../ui/Reasons";
import { Outcome, RunFigures } from "./RunFigures";
import css from "./runs.module.css";

/** Every run, the newest first. */
export function RunsPage() {
  const runs = useQuery(runsQuery);
  if (runs.error && !runs.data) return <Reasons reasons={sentences(runs.error)} />;
  if (!runs.data) return <Loader m="xl" />;
  if (runs.data.length === 0) return <NoRuns />;
  return (
    <div className={css.list}>
      <h1>Runs</h1>
      {runs.data.map((run) => (
        <RunLine key={run.id} run={run} />
      ))}
    </div>
  );
}

function RunLine({ run }: { run: RunDocument }) {
  return (
    <Link href={`/runs/${run.id}`} className={css.run}>
      <div className={css.what}>
        <b>{run.mission_name}</b>
        <span>
          {run.site_name} · {moment(run.started)}
        </span>
        {run.reason && <span>{run.reason}</span>}
      </div>
      <Outcome run={run} />
      <RunFigures run={run} />
    </Link>
  );
}

function NoRuns() {
  const toDrive = (
    <Button component={Link} href="/drive" size="lg">
      Go to Drive
    </Button>
  );
  return (
    <EmptyState icon={IconHistory} title="No run yet" action={toDrive}>
      Start a mission on the Drive page. When it ends, its map, plots, pictures and log stand here.
    </EmptyState>
  );
}
