import { useQuery } from "@tanstack/react-query";

import { get } from "../api/client";
import { Reasons } from "../ui/Reasons";
import css from "./shell.module.css";

/** Says how to log in where this browser has not, or no longer. */
export function LoginNotice() {
  const { data } = useQuery({
    queryKey: ["session"],
    queryFn: ({ signal }) => get<{ authenticated: boolean }>("/api/session", signal),
    refetchInterval: 30_000,
  });
  if (data?.authenticated !== false) return null;
  return (
    <div className={css.login}>
      <Reasons reasons={["This browser is not logged in. Open the address that the station printed in its terminal when it started."]} />
    </div>
  );
}
