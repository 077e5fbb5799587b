import { Redirect, Route, Switch } from "wouter";

import { DrivePage } from "../drive/DrivePage";
import { PlanPage } from "../plan/PlanPage";
import { RunPage } from "../runs/RunPage";
import { RunsPage } from "../runs/RunsPage";
import { SetupPage } from "../setup/SetupPage";
import { Shell } from "./Shell";

export function App() {
  return (
    <Shell>
      <Switch>
        <Route path="/plan/:siteId?">{({ siteId }) => <PlanPage siteId={siteId} />}</Route>
        <Route path="/drive">
          <DrivePage />
        </Route>
        <Route path="/setup">
          <SetupPage />
        </Route>
        <Route path="/runs">
          <RunsPage />
        </Route>
        <Route path="/runs/:runId">{({ runId }) => <RunPage runId={runId} />}</Route>
        <Route>
          <Redirect to="/drive" replace />
        </Route>
      </Switch>
    </Shell>
  );
}
