import { Button, Loader } from "@mantine/core";
import { IconMapPinPlus, IconPlugConnectedX } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";
import { Link } from "wouter";

import { sentences } from "../api/client";
import { robotQuery, siteQuery } from "../api/queries";
import { EmptyState } from "../ui/EmptyState";
import { DriveView } from "./DriveView";

export function DrivePage() {
  const robot = useQuery(robotQuery);
  const site = useQuery(siteQuery(robot.data?.site_id));
  if (robot.data && site.data) return <DriveView robot={robot.data} document={site.data} />;
  if (robot.data && !robot.data.site_id) return <NoSite />;
  const error = robot.error ?? site.error;
  if (error) {
    return (
      <EmptyState icon={IconPlugConnectedX} title="The robot cannot be shown">
        {sentences(error).join(" ")}
      </EmptyState>
    );
  }
  return <Loader m="xl" />;
}

function NoSite() {
  const toPlan = (
    <Button component={Link} href="/plan" size="lg">
      Go to Plan
    </Button>
  );
  return (
    <EmptyState icon={IconMapPinPlus} title="The robot is on no farm yet" action={toPlan}>
      Draw or import a farm on the Plan page, then choose “Simulate this farm” there.
    </EmptyState>
  );
}
