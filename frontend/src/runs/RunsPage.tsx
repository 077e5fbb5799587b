export function RunsPage(_: { siteId?: string; runId?: string }) {
  return null;
}
