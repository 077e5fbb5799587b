import { Feature } from "ol";
import { Polygon } from "ol/geom";
import { Point as OlPoint } from "ol/geom";
import { Circle, Fill, Stroke, Style } from "ol/style";

import type { Point, VehicleParams } from "../api/types";
import { ellipse, footprint } from "../geo/measure";
import type { SiteFrame } from "../geo/siteFrame";

export interface RobotPose {
  x: number;
  y: number;
  yaw: number;
  covariance?: readonly number[];
}

const BODY = new Style({ fill: new Fill({ color: "rgba(18,57,42,0.92)" }), stroke: new Stroke({ color: "#fff", width: 2.5 }), zIndex: 3 });
const NOSE = new Style({ fill: new Fill({ color: "#ffd43b" }), zIndex: 4 });
const DOUBT = new Style({ fill: new Fill({ color: "rgba(51,154,240,0.22)" }), stroke: new Stroke({ color: "#339af0", width: 2 }), zIndex: 1 });
/** Seen from afar the body is smaller than a pixel; this is not. */
const BEACON = new Style({ image: new Circle({ radius: 11, fill: new Fill({ color: "rgba(255,212,59,0.25)" }), stroke: new Stroke({ color: "#ffd43b", width: 3 }) }), zIndex: 2 });

const ELLIPSE_SIGMAS = 2;

/** The robot's body, nose, position ellipse (2 sigma) and beacon, made once and moved with each pose. */
export class RobotFeatures {
  private readonly doubt = new Feature(new Polygon([]));
  private readonly beacon = new Feature(new OlPoint([0, 0]));
  private readonly body = new Feature(new Polygon([]));
  private readonly nose = new Feature(new Polygon([]));
  readonly all: Feature[];

  constructor(
    private readonly frame: SiteFrame,
    private readonly vehicle: VehicleParams,
  ) {
    this.doubt.setStyle(DOUBT);
    this.beacon.setStyle(BEACON);
    this.body.setStyle(BODY);
    this.nose.setStyle(NOSE);
    this.all = [this.doubt, this.beacon, this.body, this.nose];
  }

  move({ x, y, yaw, covariance }: RobotPose): void {
    const { length, width } = this.vehicle;
    this.beacon.getGeometry()!.setCoordinates(this.frame.toScreen([x, y]));
    this.ring(this.body, footprint(x, y, yaw, length, width));
    this.ring(this.nose, noseTriangle(x, y, yaw, length, width));
    if (covariance && covariance.length >= 5) {
      this.ring(this.doubt, ellipse(x, y, covariance[0]!, covariance[1]!, covariance[4]!, ELLIPSE_SIGMAS));
    }
  }

  private ring(feature: Feature<Polygon>, points: Point[]): void {
    feature.getGeometry()!.setCoordinates([[...points, points[0]!].map((point) => this.frame.toScreen(point))]);
  }
}

function noseTriangle(x: number, y: number, yaw: number, length: number, width: number): Point[] {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const at = (u: number, v: number): Point => [x + c * u - s * v, y + s * u + c * v];
  return [at(length * 0.46, 0), at(length * 0.12, width * 0.3), at(length * 0.12, -width * 0.3)];
}
