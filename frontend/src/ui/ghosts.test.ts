import { expect, test } from "vitest";

import { apartWords } from "./ghosts";

test("ghosts say who is how far away", () => {
  const at = { x: 0, y: 0, yaw: 0 };
  expect(apartWords([{ source: "gnss", apart: 0.021, ...at }, { source: "map", apart: 0.31, ...at }])).toBe("GNSS 2 cm, 3D map 31 cm");
  expect(apartWords([])).toBe("");
});
