import { useEffect, useState } from "react";

const FRAME_MS = 100;

export interface Playback {
  t: number;
  playing: boolean;
  speed: number;
  seek: (t: number) => void;
  toggle: () => void;
  setSpeed: (speed: number) => void;
}

/** A clock over the run's time, 0 to `end` seconds. */
export function usePlayback(end: number): Playback {
  const [t, setT] = useState(0);
  const [playing, setPlaying] = useState(false);
  const [speed, setSpeed] = useState(4);
  useEffect(() => {
    if (!playing) return;
    const timer = setInterval(() => setT((now) => Math.min(now + (speed * FRAME_MS) / 1000, end)), FRAME_MS);
    return () => clearInterval(timer);
  }, [playing, speed, end]);
  useEffect(() => {
    if (t >= end) setPlaying(false);
  }, [t, end]);
  const toggle = () => {
    if (!playing && t >= end) setT(0);
    setPlaying(!playing);
  };
  return { t, playing, speed, seek: (to) => setT(Math.max(0, Math.min(to, end))), toggle, setSpeed };
}
