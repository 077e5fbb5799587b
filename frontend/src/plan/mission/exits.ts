import type { RowExit } from "../../api/types";

/** What to do at the far end of a row. */
export const EXITS: { value: RowExit; label: string }[] = [
  { value: "reverse", label: "Reverse out" },
  { value: "next_row", label: "Next row" },
  { value: "through", label: "Through" },
];
