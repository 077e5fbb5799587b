import { useMutation } from "@tanstack/react-query";
import { useEffect, useState } from "react";

import { post } from "../api/client";
import type { SiteDocument } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { notifyDone } from "../ui/notify";
import { type Place, asksForPlace, pressed, turned } from "./placing";

export interface Placing {
  place: Place | null;
  press: (point: [number, number]) => void;
  set: (place: Place) => void;
  turn: (by: number) => void;
  clear: () => void;
  send: () => void;
  sending: boolean;
}

/** Open while the robot asks for its place; null while it does not, and what was pressed is gone with it. */
export function usePlacing(document: SiteDocument): Placing | null {
  const status = useTopic("nav/status");
  const fresh = useFresh("nav/status");
  const asks = fresh && asksForPlace(status);
  const [place, set] = useState<Place | null>(null);
  useEffect(() => {
    if (!asks) set(null);
  }, [asks]);
  const send = useMutation({
    mutationFn: (told: Place) => post("/api/robot/place", { site_id: document.id, ...told }),
    onSuccess: () => notifyDone("The 3D map is searched there. Leave the robot standing for some seconds."),
  });
  if (!asks) return null;
  return {
    place,
    press: (point) => set((before) => pressed(point, before, document.site)),
    set,
    turn: (by) => set((before) => before && turned(before, by)),
    clear: () => set(null),
    send: () => place && send.mutate(place),
    sending: send.isPending,
  };
}
