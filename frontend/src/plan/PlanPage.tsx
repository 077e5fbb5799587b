import { Loader } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";
import { Redirect } from "wouter";

import { robotQuery, siteQuery, sitesQuery } from "../api/queries";
import { sentences } from "../api/client";
import { Reasons } from "../ui/Reasons";
import { FirstSite } from "./FirstSite";
import { Workshop } from "./Workshop";

/** Without a site in the address: the robot's own, else the first there is. */
export function PlanPage({ siteId }: { siteId?: string }) {
  const sites = useQuery(sitesQuery);
  const robot = useQuery(robotQuery);
  if (siteId) return <OneSite key={siteId} siteId={siteId} />;
  if (sites.error) return <Reasons reasons={sentences(sites.error)} />;
  if (!sites.data || robot.isPending) return <Loader m="xl" />;
  const first = sites.data.find(({ id }) => id === robot.data?.site_id) ?? sites.data[0];
  return first ? <Redirect to={`/plan/${first.id}`} replace /> : <FirstSite />;
}

function OneSite({ siteId }: { siteId: string }) {
  const site = useQuery(siteQuery(siteId));
  const [edition, setEdition] = useState(0);
  const reload = async () => {
    await site.refetch();
    setEdition((n) => n + 1);
  };
  if (site.error) return <Reasons reasons={sentences(site.error)} />;
  if (!site.data) return <Loader m="xl" />;
  return <Workshop key={edition} document={site.data} onReload={() => void reload()} />;
}
