import type { Icon } from "@tabler/icons-react";
import type { ReactNode } from "react";

import css from "./ui.module.css";

/** Nothing here yet: says so, and what to do next. */
export function EmptyState({ icon: Glyph, title, children, action }: {
  icon: Icon;
  title: string;
  children: ReactNode;
  action?: ReactNode;
}) {
  return (
    <div className={css.empty}>
      <Glyph size={48} stroke={1.5} className={css.emptyIcon} aria-hidden />
      <h3>{title}</h3>
      <p>{children}</p>
      {action}
    </div>
  );
}
