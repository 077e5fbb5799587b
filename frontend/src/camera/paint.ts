import type { Shape } from "./overlay";

const FONT = '"Inter Variable", system-ui, sans-serif';
const DARK = "rgba(0,0,0,0.72)";

/** Paints shapes on a canvas that shows the picture enlarged by `scale`; line widths and text keep their screen size. */
export function paint(ctx: CanvasRenderingContext2D, shapes: readonly Shape[], scale: number, pixelRatio: number): void {
  ctx.lineCap = "round";
  for (const shape of shapes) paintOne(ctx, shape, scale, pixelRatio);
  ctx.setLineDash([]);
}

function paintOne(ctx: CanvasRenderingContext2D, shape: Shape, scale: number, ratio: number): void {
  switch (shape.kind) {
    case "box":
      return paintBox(ctx, shape, scale, ratio);
    case "dot":
      return paintDot(ctx, shape, scale, ratio);
    case "speck":
      return paintSpeck(ctx, shape, scale, ratio);
    case "area":
      return paintArea(ctx, shape, scale, ratio);
    case "line":
      return paintLine(ctx, shape, scale, ratio);
    case "tag":
      return paintText(ctx, shape.text, shape.u * scale, shape.v * scale - 14 * ratio, shape.color, 13 * ratio);
    case "banner":
      return paintBanner(ctx, shape, ratio);
  }
}

function paintBox(ctx: CanvasRenderingContext2D, box: Extract<Shape, { kind: "box" }>, scale: number, ratio: number): void {
  ctx.setLineDash([]);
  ctx.strokeStyle = box.color;
  ctx.lineWidth = 1.5 * ratio;
  ctx.strokeRect(box.x * scale, box.y * scale, box.width * scale, box.height * scale);
  // A label wider than its box only hides the picture.
  if (box.width * scale < 44 * ratio) return;
  ctx.font = `600 ${10 * ratio}px ${FONT}`;
  ctx.textAlign = "left";
  ctx.fillStyle = box.color;
  ctx.fillText(box.text, box.x * scale + 2 * ratio, box.y * scale - 3 * ratio);
}

function paintDot(ctx: CanvasRenderingContext2D, dot: Extract<Shape, { kind: "dot" }>, scale: number, ratio: number): void {
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.arc(dot.u * scale, dot.v * scale, 4.5 * ratio, 0, 2 * Math.PI);
  ctx.lineWidth = 2 * ratio;
  ctx.strokeStyle = dot.filled ? DARK : dot.color;
  ctx.fillStyle = dot.color;
  if (dot.filled) ctx.fill();
  ctx.stroke();
}

function paintSpeck(ctx: CanvasRenderingContext2D, speck: Extract<Shape, { kind: "speck" }>, scale: number, ratio: number): void {
  ctx.fillStyle = speck.color;
  ctx.fillRect(speck.u * scale - 1.2 * ratio, speck.v * scale - 1.2 * ratio, 2.4 * ratio, 2.4 * ratio);
}

function paintArea(ctx: CanvasRenderingContext2D, area: Extract<Shape, { kind: "area" }>, scale: number, ratio: number): void {
  ctx.beginPath();
  for (const [u = 0, v = 0] of area.points) ctx.lineTo(u * scale, v * scale);
  ctx.closePath();
  ctx.setLineDash([6 * ratio, 6 * ratio]);
  ctx.lineWidth = 2 * ratio;
  ctx.strokeStyle = ctx.fillStyle = area.color;
  ctx.globalAlpha = area.filled ? 0.3 : 0.8;
  if (area.filled) ctx.fill();
  else ctx.stroke();
  ctx.globalAlpha = 1;
}

function paintLine(ctx: CanvasRenderingContext2D, line: Extract<Shape, { kind: "line" }>, scale: number, ratio: number): void {
  ctx.setLineDash(line.dash ? [10 * ratio, 8 * ratio] : []);
  for (const [color, extra] of [[DARK, 2.5], [line.color, 0]] as const) {
    ctx.beginPath();
    ctx.moveTo(line.u0 * scale, line.v0 * scale);
    ctx.lineTo(line.u1 * scale, line.v1 * scale);
    ctx.strokeStyle = color;
    ctx.lineWidth = (line.width + extra) * ratio;
    ctx.stroke();
  }
}

function paintText(ctx: CanvasRenderingContext2D, text: string, x: number, y: number, color: string, size: number): void {
  ctx.font = `700 ${size}px ${FONT}`;
  ctx.textAlign = "center";
  const width = ctx.measureText(text).width + size;
  ctx.fillStyle = DARK;
  ctx.fillRect(x - width / 2, y - size * 1.2, width, size * 1.7);
  ctx.fillStyle = color;
  ctx.fillText(text, x, y);
}

function paintBanner(ctx: CanvasRenderingContext2D, banner: Extract<Shape, { kind: "banner" }>, ratio: number): void {
  const height = 30 * ratio;
  const { width } = ctx.canvas;
  ctx.fillStyle = banner.good ? "rgba(8,48,24,0.82)" : "rgba(30,36,33,0.86)";
  ctx.fillRect(0, 0, width, height);
  ctx.fillStyle = "#fff";
  ctx.textAlign = "left";
  ctx.font = `700 ${14 * ratio}px ${FONT}`;
  ctx.fillText(banner.text, 10 * ratio, 20.5 * ratio, width - 20 * ratio);
}
