import { describe, expect, test } from "vitest";

import type { Point } from "../api/types";
import { toEcef, toGeodetic } from "./ellipsoid";
import { EnuFrame } from "./enu";
import { area, ellipse, footprint, length } from "./measure";
import { toMercator } from "./mercator";
import { SiteFrame } from "./siteFrame";

const DATUM = { lat_deg: 42.3412, lon_deg: -8.0221, height: 212.5 };

/** Computed by pyproj 3.7: ENU, latitude, longitude, height, EPSG:3857 x and y, ECEF. */
const REFERENCE: { enu: [number, number, number]; geodetic: number[]; mercator: number[]; ecef: number[] }[] = [
  {
    enu: [0, 0, 0],
    geodetic: [42.3412, -8.0221, 212.5],
    mercator: [-893016.0870927199, 5212227.370486376],
    ecef: [4675507.519701038, -658938.876357802, 4273835.983029236],
  },
  {
    enu: [100, 0, 0],
    geodetic: [42.341199993579245, -8.020886546685428, 212.50078271050006],
    mercator: [-892881.0060876404, 5212227.369519377],
    ecef: [4675521.475206496, -658839.854926448, 4273835.983029237],
  },
  {
    enu: [0, 100, 0],
    geodetic: [42.342100222644376, -8.0221, 212.50078559014946],
    mercator: [-893016.0870927199, 5212362.94980905],
    ecef: [4675440.824391245, -658929.4767081793, 4273909.897724924],
  },
  {
    enu: [-350.25, 812.5, 3.25],
    geodetic: [42.34851422231903, -8.026350610717694, 215.81146323122084],
    mercator: [-893489.262913374, 5213328.995623375],
    ecef: [4674919.119871276, -659209.662010942, 4274438.728950327],
  },
  {
    enu: [2500, -1800, -4],
    geodetic: [42.32499194767719, -7.99177143834454, 209.243727250956],
    mercator: [-889639.9270527418, 5209786.665523778],
    ecef: [4677053.99525816, -656632.1216603802, 4272502.824330077],
  },
];

const MICROMETRE_DEG = 1e-11;

describe("the way from the site to the screen agrees with pyproj", () => {
  test.each(REFERENCE)("at ENU $enu", ({ enu, geodetic, mercator, ecef }) => {
    const found = new EnuFrame(DATUM).toGeodetic(enu);
    expect(Math.abs(found.lat_deg - geodetic[0]!)).toBeLessThan(MICROMETRE_DEG);
    expect(Math.abs(found.lon_deg - geodetic[1]!)).toBeLessThan(MICROMETRE_DEG);
    expect(Math.abs(found.height - geodetic[2]!)).toBeLessThan(1e-6);
    toMercator(found.lat_deg, found.lon_deg).forEach((value, i) => expect(Math.abs(value - mercator[i]!)).toBeLessThan(1e-6));
    toEcef(found).forEach((value, i) => expect(Math.abs(value - ecef[i]!)).toBeLessThan(1e-6));
  });

  test("and back from a latitude and longitude", () => {
    const enu = new EnuFrame(DATUM).toEnu({ lat_deg: 42.35, lon_deg: -8.01, height: 200 });
    [997.0131257398461, 977.6056131239791, -12.652884491291672].forEach((value, i) =>
      expect(Math.abs(enu[i]! - value)).toBeLessThan(1e-6),
    );
  });
});

describe("what is drawn on the screen comes back to the same metres", () => {
  const frame = new SiteFrame({ ...DATUM, height_m: 212.5, frame: "WGS 84", corrections: "" });
  test.each<Point>([[0, 0], [120.5, -75.25], [-2400, 1900]])("at %f, %f", (e, n) => {
    const back = frame.fromScreen(frame.toScreen([e, n]));
    expect(Math.hypot(back[0] - e, back[1] - n)).toBeLessThan(1e-6);
  });

  test("earth-centred and geodetic coordinates undo each other near the poles and the equator", () => {
    for (const lat_deg of [-89.9, -33.2, 0, 12, 71.5, 89.9]) {
      const back = toGeodetic(toEcef({ lat_deg, lon_deg: 171.3, height: 1850 }));
      expect(Math.abs(back.lat_deg - lat_deg)).toBeLessThan(MICROMETRE_DEG);
      expect(Math.abs(back.height - 1850)).toBeLessThan(1e-3);
    }
  });
});

describe("measures", () => {
  test("a polyline is as long as its parts", () => expect(length([[0, 0], [3, 4], [3, 10]])).toBeCloseTo(11));
  test("a rectangle's area is length times width", () => expect(area([[0, 0], [4, 0], [4, 2.5], [0, 2.5]])).toBeCloseTo(10));
  test("a footprint facing north has its front left corner in the north west", () => {
    const [frontLeft] = footprint(10, 20, Math.PI / 2, 1.2, 0.8);
    expect(frontLeft![0]).toBeCloseTo(9.6);
    expect(frontLeft![1]).toBeCloseTo(20.6);
  });
  test("an error ellipse reaches the standard deviation along its axis", () => {
    const corners = ellipse(0, 0, 0.04, 0, 0.01, 2);
    expect(Math.max(...corners.map(([x]) => x))).toBeCloseTo(0.4);
    expect(Math.max(...corners.map(([, y]) => y))).toBeCloseTo(0.2);
  });
});
