import type { Mark } from "./topView";

/** The robot stands at this share of the canvas' height from its top. */
const ROBOT_AT = 0.64;
/** The canvas shows so many metres from top to bottom. */
const SHOWN = 16;
/** Rings around the robot, m. */
const RINGS = [2, 4, 6, 8, 10];
const FONT = '"Inter Variable", system-ui, sans-serif';

interface Frame {
  /** Canvas pixels of a place, x ahead and y to the left in metres. */
  at: (x: number, y: number) => [number, number];
  scale: number;
  ratio: number;
}

/** Paints marks on a canvas, straight ahead upwards. */
export function paintTopView(ctx: CanvasRenderingContext2D, marks: readonly Mark[], ratio: number): void {
  const { width, height } = ctx.canvas;
  const scale = height / SHOWN;
  const frame: Frame = { at: (x, y) => [width / 2 - y * scale, height * ROBOT_AT - x * scale], scale, ratio };
  ctx.clearRect(0, 0, width, height);
  rings(ctx, frame);
  for (const mark of marks) paintOne(ctx, mark, frame);
  robot(ctx, frame);
  ctx.setLineDash([]);
}

function rings(ctx: CanvasRenderingContext2D, { at, scale, ratio }: Frame): void {
  const [u, v] = at(0, 0);
  ctx.setLineDash([]);
  ctx.lineWidth = ratio;
  ctx.strokeStyle = "rgb(255 255 255 / 14%)";
  ctx.fillStyle = "rgb(255 255 255 / 60%)";
  ctx.font = `600 ${11 * ratio}px ${FONT}`;
  ctx.textAlign = "center";
  for (const metres of RINGS) {
    ctx.beginPath();
    ctx.arc(u, v, metres * scale, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.fillText(`${metres} m`, u, v - metres * scale - 3 * ratio);
  }
}

function paintOne(ctx: CanvasRenderingContext2D, mark: Mark, frame: Frame): void {
  switch (mark.kind) {
    case "speck":
      return paintSpeck(ctx, mark, frame);
    case "disc":
      return paintDisc(ctx, mark, frame);
    case "line":
      return paintLine(ctx, mark, frame);
  }
}

function paintSpeck(ctx: CanvasRenderingContext2D, mark: Extract<Mark, { kind: "speck" }>, { at, ratio }: Frame): void {
  const [u, v] = at(mark.x, mark.y);
  ctx.fillStyle = "rgb(255 255 255 / 75%)";
  ctx.fillRect(u - ratio, v - ratio, 2 * ratio, 2 * ratio);
}

/** A trunk keeps its true size, but never less than an eye can find. */
function paintDisc(ctx: CanvasRenderingContext2D, mark: Extract<Mark, { kind: "disc" }>, { at, scale, ratio }: Frame): void {
  const [u, v] = at(mark.x, mark.y);
  ctx.globalAlpha = mark.opacity;
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.arc(u, v, Math.max(mark.radius * scale, 4.5 * ratio), 0, 2 * Math.PI);
  ctx.fillStyle = ctx.strokeStyle = mark.color;
  ctx.lineWidth = 2 * ratio;
  if (mark.filled) ctx.fill();
  else ctx.stroke();
  ctx.globalAlpha = 1;
}

function paintLine(ctx: CanvasRenderingContext2D, mark: Extract<Mark, { kind: "line" }>, { at, ratio }: Frame): void {
  ctx.setLineDash(mark.dash ? [8 * ratio, 7 * ratio] : []);
  ctx.beginPath();
  ctx.moveTo(...at(mark.x0, mark.y0));
  ctx.lineTo(...at(mark.x1, mark.y1));
  ctx.strokeStyle = mark.color;
  ctx.lineWidth = mark.width * ratio;
  ctx.stroke();
}

function robot(ctx: CanvasRenderingContext2D, { at, scale, ratio }: Frame): void {
  const [u, v] = at(0, 0);
  const [length, width] = [1.16 * scale, 0.815 * scale];
  ctx.setLineDash([]);
  ctx.fillStyle = "rgb(28 126 214 / 85%)";
  ctx.strokeStyle = "#fff";
  ctx.lineWidth = 1.5 * ratio;
  ctx.beginPath();
  ctx.roundRect(u - width / 2, v - length / 2, width, length, 4 * ratio);
  ctx.fill();
  ctx.stroke();
  ctx.beginPath();
  ctx.moveTo(u - width / 4, v - length / 4);
  ctx.lineTo(u, v - length / 2.3);
  ctx.lineTo(u + width / 4, v - length / 4);
  ctx.stroke();
}
