/** Short names for the vocabulary that the station declares (schema.d.ts is generated from its OpenAPI). */
import type { components } from "./schema";

type S = components["schemas"];

export type Point = [number, number];
export type CameraView = S["CameraView"];
export type Datum = S["Datum"];
export type GnssFix = S["GnssFix"];
export type Job = S["Job"];
export type Lane = S["Lane"];
export type LinkLossPolicy = S["LinkLossPolicy"];
export type Mission = S["Mission"];
export type MissionDocument = S["MissionDocument"];
export type MissionPlan = S["MissionPlan"];
export type ModeSwitch = S["ModeSwitch"];
export type NavMode = S["NavMode"];
export type NavStatus = S["NavStatus"];
export type OrthophotoInfo = S["OrthophotoInfo"];
export type PathSegment = S["PathSegment"];
export type Preview = S["Preview"];
export type Robot = S["Robot"];
export type Row = S["Row"];
export type RowExit = S["RowExit"];
export type RowVisit = S["RowVisit"];
export type RunDetail = S["RunDetail"];
export type RunDocument = S["RunDocument"];
export type RunOutcome = S["RunOutcome"];
export type RunState = S["RunState"];
export type RunTrack = S["RunTrack"];
export type SegmentKind = S["SegmentKind"];
export type SiteDocument = S["SiteDocument"];
export type SiteMap = S["SiteMap"];
export type SiteSummary = S["SiteSummary"];
export type VehicleParams = S["VehicleParams"];
export type Warehouse = S["Warehouse"];
export type Waypoint = S["Waypoint"];
export type Zone = S["Zone"];
export type ZoneKind = S["ZoneKind"];
