import { Button, NumberInput, SegmentedControl } from "@mantine/core";
import { IconPrinter } from "@tabler/icons-react";

import { Card } from "../ui/Card";
import { type BoardForm, printPath } from "./boardForm";
import css from "./setup.module.css";

const KINDS = [
  { value: "chess", label: "Chessboard" },
  { value: "charuco", label: "ChArUco" },
];

/** Which board is held before the camera, and how to print one. */
export function BoardCard({ form, onChange }: { form: BoardForm; onChange: (form: BoardForm) => void }) {
  const number = (key: "columns" | "rows" | "square_mm" | "plate_width_mm" | "plate_height_mm", label: string, min: number, max: number, suffix = "") => (
    <NumberInput
      label={label}
      min={min}
      max={max}
      suffix={suffix}
      clampBehavior="blur"
      decimalScale={suffix ? 2 : 0}
      value={form[key]}
      onChange={(value) => typeof value === "number" && value >= min && value <= max && onChange({ ...form, [key]: value })}
    />
  );
  return (
    <Card title="Board" className={css.beginCard}>
      <SegmentedControl value={form.charuco ? "charuco" : "chess"} onChange={(kind) => onChange({ ...form, charuco: kind === "charuco" })} data={KINDS} aria-label="Kind of board" />
      <div className={css.pair}>
        {number("columns", "Inner corners across", 3, 20)}
        {number("rows", "Inner corners down", 3, 20)}
        {number("square_mm", "Side of a square", 2, 1000, " mm")}
      </div>
      <p>Inner corners are where two black squares meet. Measure a square on the print: printers scale.</p>
      <details>
        <summary>Size of the plate, for the LiDAR</summary>
        <div className={css.pair}>
          {number("plate_width_mm", "Plate across", 0, 3000, " mm")}
          {number("plate_height_mm", "Plate down", 0, 3000, " mm")}
        </div>
        <p>0 means a white edge one square wide.</p>
      </details>
      <Button component="a" href={printPath(form)} target="_blank" rel="noopener" variant="default" leftSection={<IconPrinter size={20} aria-hidden />}>
        Print at true size
      </Button>
    </Card>
  );
}
