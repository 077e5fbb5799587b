import { ActionIcon, NumberInput } from "@mantine/core";
import { IconMinus, IconPlus } from "@tabler/icons-react";

interface Props {
  label: string;
  unit: string;
  value: number;
  min: number;
  max: number;
  step: number;
  onChange: (value: number) => void;
  /** Buttons to step up and down, where there is room for a finger. */
  steps?: boolean;
  /** For a row of a list that says already what it is about. */
  labelHidden?: boolean;
}

const STEP_PX = 44;

/** A number with its unit; what is out of bounds or no number is not taken. */
export function NumberField({ label, unit, value, onChange, steps = false, labelHidden = false, ...bounds }: Props) {
  const take = (next: number) => next >= bounds.min && next <= bounds.max && onChange(next);
  const stepper = (direction: 1 | -1) => (
    <ActionIcon variant="subtle" size={STEP_PX} onClick={() => take(Number((value + direction * bounds.step).toFixed(3)))} aria-label={`${label}: ${direction > 0 ? "more" : "less"}`}>
      {direction > 0 ? <IconPlus size={20} /> : <IconMinus size={20} />}
    </ActionIcon>
  );
  return (
    <NumberInput
      label={labelHidden ? undefined : label}
      aria-label={labelHidden ? label : undefined}
      suffix={` ${unit}`}
      value={Number(value.toFixed(3))}
      clampBehavior="blur"
      decimalScale={2}
      onChange={(next) => typeof next === "number" && take(next)}
      hideControls
      leftSection={steps && stepper(-1)}
      leftSectionWidth={steps ? STEP_PX : undefined}
      rightSection={steps && stepper(1)}
      rightSectionWidth={steps ? STEP_PX : undefined}
      {...bounds}
    />
  );
}
