/** Numbers as the operator reads them: always with their unit, "–" where there is none. */

const NONE = "–";

type Maybe = number | null | undefined;

const known = (value: Maybe): value is number => value !== null && value !== undefined && Number.isFinite(value);

const fixed = (value: number, digits: number) => {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
};

const withUnit = (unit: string, digits: number, factor = 1) => (value: Maybe) =>
  known(value) ? `${fixed(value * factor, digits)} ${unit}` : NONE;

export const speed = withUnit("m/s", 2);
export const metres = withUnit("m", 1);
export const centimetres = withUnit("cm", 0, 100);
/** A 1-sigma; never better than the centimetre that it is told in. */
export const accuracy = (sigma: Maybe) => centimetres(known(sigma) ? Math.max(sigma, 0.01) : sigma);
export const degrees = withUnit("°", 1, 180 / Math.PI);
export const volts = withUnit("V", 1);
export const seconds = withUnit("s", 1);
export const percent = withUnit("%", 0, 100);
export const hectares = withUnit("ha", 2, 1e-4);

/** Metres below a kilometre, kilometres above. */
export const way = (value: Maybe) => (known(value) && value >= 1000 ? `${fixed(value / 1000, 2)} km` : metres(value));

/** 1 h 04 min, 4 min 05 s, 12 s. */
export function duration(value: Maybe): string {
  if (!known(value)) return NONE;
  const total = Math.round(value);
  const [h, m, s] = [Math.floor(total / 3600), Math.floor(total / 60) % 60, total % 60];
  const two = (n: number) => String(n).padStart(2, "0");
  if (h > 0) return `${h} h ${two(m)} min`;
  return m > 0 ? `${m} min ${two(s)} s` : `${s} s`;
}

/** 4:05, as a place in a run. */
export function clock(t: number): string {
  const whole = Math.max(0, Math.floor(t));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

export function bytes(value: Maybe): string {
  if (!known(value)) return NONE;
  const [unit, size] = value >= 1e9 ? ["GB", 1e9] : value >= 1e6 ? ["MB", 1e6] : ["kB", 1e3];
  return `${fixed(value / (size as number), 1)} ${unit}`;
}

const WALL_CLOCK = new Intl.DateTimeFormat("en-GB", { dateStyle: "medium", timeStyle: "short" });

export const moment = (iso: string) => WALL_CLOCK.format(new Date(iso));
