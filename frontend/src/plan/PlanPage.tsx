export function PlanPage(_: { siteId?: string; runId?: string }) {
  return null;
}
