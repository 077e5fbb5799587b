import type { ReactNode } from "react";

import css from "./ui.module.css";

export function Card({ title, children, className = "" }: { title?: ReactNode; children: ReactNode; className?: string }) {
  return (
    <section className={`${css.card} ${className}`}>
      {title && <h2 className={css.cardTitle}>{title}</h2>}
      {children}
    </section>
  );
}
