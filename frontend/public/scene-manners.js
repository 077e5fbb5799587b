// The station puts this before everything else in the 3D viewer's page, so that the viewer keeps the manners of the house.
"use strict";

(() => {
  // The viewer's sorter of Gaussian splats compiles strings to code, which the content security policy forbids.
  // Nothing here is drawn with splats, so the sorter is never fetched.
  const fetchAny = window.fetch.bind(window);
  const isSorter = (resource) => String(resource).startsWith("data:application/wasm");
  window.fetch = (resource, options) => (isSorter(resource) ? new Promise(() => {}) : fetchAny(resource, options));

  // The viewer lives in the same thread as the page around it, with its stop button. It may draw for a fifth of the
  // time, and never more often than the robot's picture changes.
  const SHORTEST_PAUSE_MS = 60;
  const REST_PER_WORK = 4;
  const requestFrame = window.requestAnimationFrame.bind(window);
  const cancelFrame = window.cancelAnimationFrame.bind(window);
  const waiting = new Map();
  let newest = 0;
  let nextFrame = 0;

  function draw(callback, now) {
    const begun = performance.now();
    try {
      callback(now);
    } finally {
      const ended = performance.now();
      nextFrame = Math.max(nextFrame, ended + Math.max(SHORTEST_PAUSE_MS, REST_PER_WORK * (ended - begun)));
    }
  }

  window.requestAnimationFrame = (callback) => {
    const number = ++newest;
    const entry = { timer: 0, frame: 0 };
    const whenFrame = (now) => {
      waiting.delete(number);
      draw(callback, now);
    };
    entry.timer = setTimeout(() => (entry.frame = requestFrame(whenFrame)), Math.max(0, nextFrame - performance.now()));
    waiting.set(number, entry);
    return number;
  };

  window.cancelAnimationFrame = (number) => {
    const entry = waiting.get(number);
    if (!entry) return;
    clearTimeout(entry.timer);
    cancelFrame(entry.frame);
    waiting.delete(number);
  };
})();
