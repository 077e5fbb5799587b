/** The board as the form has it: sizes in mm, as people measure them. */
import { useLocalStorage } from "@mantine/hooks";

import type { Board } from "../api/types";

export interface BoardForm {
  columns: number;
  rows: number;
  square_mm: number;
  charuco: boolean;
  /** Of the whole plate; 0 for a white edge one square wide. */
  plate_width_mm: number;
  plate_height_mm: number;
}

/** The published board. */
export const USUAL_BOARD: BoardForm = { columns: 8, rows: 5, square_mm: 27, charuco: false, plate_width_mm: 0, plate_height_mm: 0 };

export function toBoard(form: BoardForm): Board {
  const { columns, rows, charuco } = form;
  return { columns, rows, charuco, square: form.square_mm / 1000, width: form.plate_width_mm / 1000, height: form.plate_height_mm / 1000 };
}

export function printPath({ columns, rows, square_mm, charuco }: BoardForm): string {
  return `/api/calibration/board?${new URLSearchParams({ columns: `${columns}`, rows: `${rows}`, square_mm: `${square_mm}`, charuco: `${charuco}` })}`;
}

/** "8 x 5 inner corners, squares of 27 mm" */
export function boardWords(board: Board): string {
  const kind = board.charuco ? "ChArUco, " : "";
  return `${kind}${board.columns} × ${board.rows} inner corners, squares of ${Number((1000 * (board.square ?? 0)).toFixed(2))} mm`;
}

/** Kept in this browser: a farm has one board. */
export function useBoardForm(): [BoardForm, (form: BoardForm) => void] {
  const [form, setForm] = useLocalStorage<BoardForm>({ key: "rowpilot.board", defaultValue: USUAL_BOARD, getInitialValueInEffect: false });
  return [{ ...USUAL_BOARD, ...form }, setForm];
}
