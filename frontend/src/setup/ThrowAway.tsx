import { Button } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";

import { remove } from "../api/client";
import { calibrationQuery } from "../api/queries";
import { HoldButton } from "../ui/HoldButton";
import { notifyError } from "../ui/notify";
import css from "./setup.module.css";

/** Ends the calibration without a result: at once where nothing was taken, else only on purpose. */
export function ThrowAway({ taken }: { taken: number }) {
  const client = useQueryClient();
  const end = useMutation({
    mutationFn: () => remove("/api/calibration"),
    onSuccess: () => client.invalidateQueries({ queryKey: calibrationQuery.queryKey }),
    onError: notifyError,
  });
  if (taken === 0) {
    return (
      <Button variant="default" size="lg" loading={end.isPending} onClick={() => end.mutate()}>
        Leave the calibration
      </Button>
    );
  }
  return (
    <div className={css.throwAway}>
      <HoldButton disabled={end.isPending} onHeld={() => end.mutate()}>
        Hold to throw everything away
      </HoldButton>
    </div>
  );
}
