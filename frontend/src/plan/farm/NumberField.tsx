import { NumberInput } from "@mantine/core";

interface Props {
  label: string;
  unit: string;
  value: number;
  min: number;
  max: number;
  step: number;
  onChange: (value: number) => void;
}

/** A number with its unit; what is out of bounds or no number is not taken. */
export function NumberField({ label, unit, value, onChange, ...bounds }: Props) {
  return (
    <NumberInput
      label={label}
      suffix={` ${unit}`}
      value={Number(value.toFixed(3))}
      clampBehavior="blur"
      decimalScale={2}
      onChange={(next) => typeof next === "number" && next >= bounds.min && next <= bounds.max && onChange(next)}
      {...bounds}
    />
  );
}
