import { expect, test } from "vitest";

import { begin, commit, redo, undo } from "./history";

const drawn = ["b", "c"].reduce(commit, begin("a"));

test("undo goes back step by step and no further than the beginning", () => {
  expect(undo(drawn).present).toBe("b");
  expect(undo(undo(undo(drawn))).present).toBe("a");
});

test("redo brings back what was undone, in order", () => {
  const back = undo(undo(drawn));
  expect(redo(back).present).toBe("b");
  expect(redo(redo(redo(back))).present).toBe("c");
});

test("a new step after an undo forgets what was undone", () => {
  const branched = commit(undo(drawn), "d");
  expect(redo(branched).present).toBe("d");
  expect(undo(branched).present).toBe("b");
});

test("a step that changes nothing is none", () => expect(commit(drawn, "c").past).toEqual(["a", "b"]));
