/** Whether a robot that stands could start, by the navigator's own events; these refuse a start. */
import type { MissionPlan, NavStatus } from "../api/types";
import { distance } from "../geo/measure";
import { STATE_TONES, STATE_WORDS, type Tone, isUnderWay } from "./words";

/** From farther away the navigator refuses to start a mission, m. */
export const START_REACH = 3;

const WAITING: Record<string, string> = {
  chassis_silent: "Waiting for the chassis",
  emergency_stop: "Emergency stop is pressed",
  chassis_fault: "Chassis fault",
  remote_control: "Under remote control",
  battery_empty: "Battery empty",
  battery_low: "Battery low",
  no_position: "Waiting for a position",
  position_unsure: "Waiting for a better position",
};

const standsInTheWay = ({ effect }: { effect: string }) => effect.split(", ").includes("NO_ENTRY");

/** The events for which a start would be refused now; none while a mission is under way. */
const hindrances = ({ state, events }: NavStatus) => (isUnderWay(state) ? [] : events.filter(standsInTheWay));

/** The robot's state in words: "Ready" only where a start would be taken. */
export function stateWords(status: NavStatus): string {
  const first = status.state === "idle" ? hindrances(status)[0] : undefined;
  return first ? (WAITING[first.name] ?? "Cannot start yet") : STATE_WORDS[status.state];
}

export const stateTone = (status: NavStatus): Tone => (status.state === "idle" && hindrances(status).length > 0 ? "warn" : STATE_TONES[status.state]);

/** Every reason why this plan cannot be started now, in sentences. */
export function startHindrances(status: NavStatus, plan: MissionPlan | null): string[] {
  const away = plan && status.pose ? distanceToStart(plan, status.pose) : 0;
  const far = away > START_REACH ? [`The robot is ${away.toFixed(1)} m from the mission’s start. Bring it there first.`] : [];
  return [...hindrances(status).map(({ text }) => text), ...far];
}

function distanceToStart({ segments }: MissionPlan, { x, y }: { x: number; y: number }): number {
  const start = segments[0]?.points[0];
  return start ? distance([x, y], [start[0], start[1]]) : 0;
}
