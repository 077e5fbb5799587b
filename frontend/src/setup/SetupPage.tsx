import { Loader } from "@mantine/core";
import { IconPlugConnectedX } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";

import { sentences } from "../api/client";
import { calibrationQuery, robotQuery } from "../api/queries";
import { EmptyState } from "../ui/EmptyState";
import { SessionView } from "./SessionView";
import { SetupHome } from "./SetupHome";

/** Calibration: the one that is under way, or what can be begun and what was found before. */
export function SetupPage() {
  const calibration = useQuery(calibrationQuery);
  const robot = useQuery(robotQuery);
  if (calibration.data?.setup) return <SessionView document={calibration.data} setup={calibration.data.setup} />;
  if (calibration.data && robot.data) return <SetupHome robot={robot.data} />;
  const error = calibration.error ?? robot.error;
  if (error) {
    return (
      <EmptyState icon={IconPlugConnectedX} title="Setup cannot be shown">
        {sentences(error).join(" ")}
      </EmptyState>
    );
  }
  return <Loader m="xl" />;
}
