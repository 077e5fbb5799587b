import { expect, test } from "vitest";

import { positionSigma } from "./words";

test("accuracy is the larger axis of the ellipse", () => expect(positionSigma([0.01, 0, 0, 0, 0.04])).toBeCloseTo(0.2));
