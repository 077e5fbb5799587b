import { useMutation } from "@tanstack/react-query";
import { useEffect, useState } from "react";

import { post } from "../api/client";
import type { SiteDocument } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { notifyDone } from "../ui/notify";
import { type Place, asksForPlace, mayBePlaced, pressed, turned } from "./placing";

export interface Placing {
  /** The robot itself asks; else an operator wants to correct it. */
  asked: boolean;
  place: Place | null;
  press: (point: [number, number]) => void;
  set: (place: Place) => void;
  turn: (by: number) => void;
  /** Throws the press away; the card of an operator who was not asked closes. */
  clear: () => void;
  send: () => void;
  sending: boolean;
}

/** `placing` is open while the robot asks for its place or an operator has chosen to say it; `open` where he may. */
export function usePlacing(document: SiteDocument): { placing: Placing | null; open: (() => void) | null } {
  const { asked, may } = useWhetherToAsk();
  const [wanted, setWanted] = useState(false);
  const [place, set] = useState<Place | null>(null);
  const shown = asked || (wanted && may);
  useEffect(() => {
    if (shown) return;
    set(null);
    setWanted(false);
  }, [shown]);
  const clear = () => {
    set(null);
    setWanted(false);
  };
  const send = useMutation({
    mutationFn: (told: Place) => post("/api/robot/place", { site_id: document.id, ...told }),
    onSuccess: () => {
      setWanted(false);
      notifyDone("The 3D map is searched there. Leave the robot standing for some seconds.");
    },
  });
  const placing: Placing = {
    asked,
    place,
    press: (point) => set((before) => pressed(point, before, document.site)),
    set,
    turn: (by) => set((before) => before && turned(before, by)),
    clear,
    send: () => place && send.mutate(place),
    sending: send.isPending,
  };
  return { placing: shown ? placing : null, open: may && !shown ? () => setWanted(true) : null };
}

function useWhetherToAsk(): { asked: boolean; may: boolean } {
  const status = useTopic("nav/status");
  const match = useTopic("lidar3d/match");
  const fresh = useFresh("nav/status");
  const matches = useFresh("lidar3d/match");
  return { asked: fresh && asksForPlace(status), may: fresh && matches && mayBePlaced(status, match) };
}
