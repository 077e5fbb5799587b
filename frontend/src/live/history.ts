import type { ModeSwitch, NavMode, NavStatus, Point, RunTrack } from "../api/types";

const STEP = 0.1;
const SAMPLE_NS = 200e6;
const KEPT_SAMPLES = 1500;

/** Columns for the live plots; `t` in seconds. */
export interface Samples {
  t: number[];
  lateral: (number | null)[];
  v: number[];
  mode: NavMode[];
}

const noSamples = (): Samples => ({ t: [], lateral: [], v: [], mode: [] });

/** What the page remembers of the run under way: the driven line, the last minutes in columns, the switches. */
export class RunHistory {
  runId: string | null = null;
  trail: Point[] = [];
  samples: Samples = noSamples();
  switches: ModeSwitch[] = [];
  /** Stamp of the first status seen of this run. */
  startNs = 0;
  /** The run that was under way already when this page was opened: its start must be asked for. */
  missed: string | null = null;
  private opened = false;
  private lastSample = -Infinity;

  add(status: NavStatus): void {
    if (!this.opened) this.missed = status.run_id;
    this.opened = true;
    if (status.run_id !== this.runId) this.begin(status);
    if (status.run_id === null) return;
    if (status.pose) this.extendTrail([status.pose.x, status.pose.y]);
    if (status.stamp_ns - this.lastSample >= SAMPLE_NS) this.addSample(status);
  }

  addSwitch(modeSwitch: ModeSwitch): void {
    this.switches = [...this.switches, modeSwitch];
  }

  /** Puts what the station recorded before this page was opened in front of what the page has seen. */
  seed(runId: string, track: RunTrack): void {
    if (runId !== this.runId || this.missed !== runId) return;
    this.missed = null;
    this.trail = [...thinned(track), ...this.trail];
    const known = new Set(this.switches.map(({ stamp_ns }) => stamp_ns));
    this.switches = [...track.switches.filter(({ stamp_ns }) => !known.has(stamp_ns)), ...this.switches];
  }

  private begin({ run_id, stamp_ns }: NavStatus): void {
    this.runId = run_id;
    this.startNs = stamp_ns;
    this.trail = [];
    this.samples = noSamples();
    this.switches = [];
    this.lastSample = -Infinity;
  }

  private extendTrail(point: Point): void {
    if (isStep(this.trail.at(-1), point)) this.trail.push(point);
  }

  private addSample({ stamp_ns, lateral_error, v, mode }: NavStatus): void {
    this.lastSample = stamp_ns;
    const { samples } = this;
    samples.t.push(stamp_ns / 1e9);
    samples.lateral.push(lateral_error);
    samples.v.push(v);
    samples.mode.push(mode);
    if (samples.t.length > KEPT_SAMPLES) Object.values(samples).forEach((column: unknown[]) => column.shift());
  }
}

const isStep = (from: Point | undefined, to: Point) => !from || Math.hypot(to[0] - from[0], to[1] - from[1]) >= STEP;

function thinned({ x, y }: RunTrack): Point[] {
  const points: Point[] = [];
  x.forEach((east, i) => {
    const point: Point = [east, y[i]!];
    if (isStep(points.at(-1), point)) points.push(point);
  });
  return points;
}
