import { ActionIcon, useMantineColorScheme } from "@mantine/core";
import { IconAdjustments, IconHistory, IconMap2, IconMoon, IconSteeringWheel, IconSun } from "@tabler/icons-react";
import type { ReactNode } from "react";
import { Link, useLocation } from "wouter";

import { LoginNotice } from "./LoginNotice";
import { StatusPill } from "./StatusPill";
import { StopButton } from "./StopButton";
import css from "./shell.module.css";

const PAGES = [
  { path: "/plan", word: "Plan", icon: IconMap2 },
  { path: "/drive", word: "Drive", icon: IconSteeringWheel },
  { path: "/runs", word: "Runs", icon: IconHistory },
  { path: "/setup", word: "Setup", icon: IconAdjustments },
];

/** Header, navigation and the stop button, around every page. On a phone both lie under the thumb. */
export function Shell({ children }: { children: ReactNode }) {
  return (
    <div className={css.shell}>
      <header className={css.header}>
        <div className={css.brand}>
          <img src="/favicon.svg" alt="" width={32} height={32} />
          <span>Rowpilot</span>
        </div>
        <StatusPill />
        <SchemeToggle />
      </header>
      <nav className={css.nav} aria-label="Pages">
        <Pages />
      </nav>
      <div className={css.stop}>
        <StopButton />
      </div>
      <main className={css.main}>
        <LoginNotice />
        {children}
      </main>
    </div>
  );
}

function Pages() {
  const [location] = useLocation();
  return PAGES.map(({ path, word, icon: Glyph }) => (
    <Link key={path} href={path} className={css.page} aria-current={location.startsWith(path) ? "page" : undefined}>
      <Glyph size={24} aria-hidden />
      {word}
    </Link>
  ));
}

function SchemeToggle() {
  // Holding transitions still would inject a style element, which the CSP forbids.
  const { colorScheme, toggleColorScheme } = useMantineColorScheme({ keepTransitions: true });
  const dark = colorScheme === "dark";
  return (
    <ActionIcon variant="transparent" color="white" className={css.scheme} onClick={toggleColorScheme} aria-label={dark ? "Light colours" : "Dark colours"}>
      {dark ? <IconSun size={24} /> : <IconMoon size={24} />}
    </ActionIcon>
  );
}
