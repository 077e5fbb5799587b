export function RunPage(_: { siteId?: string; runId?: string }) {
  return null;
}
