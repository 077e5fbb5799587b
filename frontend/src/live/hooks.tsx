import { type ReactNode, createContext, useCallback, useContext, useEffect, useMemo, useSyncExternalStore } from "react";

import type { TopicName, Topics } from "./message";
import { RunHistory } from "./history";
import { LiveLink } from "./link";
import { type LinkState, liveUrl } from "./socket";
import { LiveStore } from "./store";

interface Live {
  store: LiveStore;
  link: LiveLink;
  history: RunHistory;
}

const LiveContext = createContext<Live | null>(null);

export function LiveProvider({ children }: { children: ReactNode }) {
  const live = useMemo(newLive, []);
  useEffect(() => {
    live.link.open();
    return () => live.link.close();
  }, [live]);
  useEffect(() => remember(live), [live]);
  return <LiveContext.Provider value={live}>{children}</LiveContext.Provider>;
}

function newLive(): Live {
  const store = new LiveStore();
  return { store, link: new LiveLink(store, liveUrl(window.location)), history: new RunHistory() };
}

function remember({ store, history }: Live): () => void {
  const ends = [
    store.subscribe("nav/status", () => history.add(store.newest("nav/status")!.data)),
    store.subscribe("nav/switch", () => history.addSwitch(store.newest("nav/switch")!.data)),
  ];
  return () => ends.forEach((end) => end());
}

function useLive(): Live {
  const live = useContext(LiveContext);
  if (!live) throw new Error("LiveProvider is missing above this component");
  return live;
}

/** For drawings that follow every message by themselves. */
export const useLiveStore = () => useLive().store;

/** What this page remembers of the run under way; it changes in place. */
export const useRunHistory = () => useLive().history;

/** Words need not change more often than eyes can read. */
const READABLE_MS = 150;

/** Newest data of a topic, at a readable pace; null before the first. */
export function useTopic<T extends TopicName>(topic: T): Topics[T] | null {
  const store = useLiveStore();
  const subscribe = useCallback((changed: () => void) => subscribeAtPace(store, topic, changed), [store, topic]);
  return useSyncExternalStore(subscribe, () => store.newest(topic)?.data ?? null);
}

function subscribeAtPace(store: LiveStore, topic: TopicName, changed: () => void): () => void {
  let pending: number | undefined;
  const end = store.subscribe(topic, () => {
    pending ??= window.setTimeout(() => {
      pending = undefined;
      changed();
    }, READABLE_MS);
  });
  return () => {
    window.clearTimeout(pending);
    end();
  };
}

const FRESHNESS_CHECK_MS = 200;

/** Whether the topic's newest message is younger than a second. */
export function useFresh(topic: TopicName): boolean {
  const store = useLiveStore();
  const subscribe = useCallback((changed: () => void) => {
    const timer = window.setInterval(changed, FRESHNESS_CHECK_MS);
    return () => window.clearInterval(timer);
  }, []);
  return useSyncExternalStore(subscribe, () => store.isFresh(topic, performance.now()));
}

export function useLink(): LinkState {
  const { link } = useLive();
  return useSyncExternalStore(
    useCallback((changed: () => void) => link.subscribe(changed), [link]),
    () => link.state,
  );
}
