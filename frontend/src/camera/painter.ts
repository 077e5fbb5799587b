import type { Shape } from "./overlay";
import { paint } from "./paint";

/** A description tells the picture's size, in whose pixels everything is drawn; the JPEG may be smaller. */
export interface Described {
  width_px: number;
  height_px: number;
}

export interface Picture<V extends Described> {
  view: V;
  jpeg: Blob;
}

export type Draw<V> = (view: V) => readonly Shape[];

/** Shows pictures with their own lines: both come from one message and reach the canvas in one stroke. Newest wins. */
export class PicturePainter<V extends Described> {
  private shown: { view: V; bitmap: ImageBitmap } | null = null;
  private next: Picture<V> | null = null;
  private decoding = false;
  private closed = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private shapes: Draw<V>,
  ) {}

  show(picture: Picture<V>): void {
    this.next = picture;
    if (!this.decoding) void this.decode();
  }

  setShapes(shapes: Draw<V>): void {
    this.shapes = shapes;
    this.draw();
  }

  /** Draws again at the canvas's present size. */
  draw(): void {
    if (!this.shown || this.closed) return;
    const { view, bitmap } = this.shown;
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.canvas;
    const width = Math.round(ratio * Math.min(clientWidth, (clientHeight * view.width_px) / view.height_px));
    const height = Math.round((width * view.height_px) / view.width_px);
    if (width === 0) return;
    this.canvas.width = width;
    this.canvas.height = height;
    const ctx = this.canvas.getContext("2d")!;
    ctx.drawImage(bitmap, 0, 0, width, height);
    paint(ctx, this.shapes(view), width / view.width_px, ratio);
  }

  close(): void {
    this.closed = true;
    this.shown?.bitmap.close();
    this.shown = null;
  }

  private async decode(): Promise<void> {
    this.decoding = true;
    while (this.next && !this.closed) {
      const { view, jpeg } = this.next;
      this.next = null;
      const bitmap = await createImageBitmap(jpeg).catch(() => null);
      if (bitmap) this.put(view, bitmap);
    }
    this.decoding = false;
  }

  private put(view: V, bitmap: ImageBitmap): void {
    this.shown?.bitmap.close();
    this.shown = { view, bitmap };
    this.draw();
  }
}
