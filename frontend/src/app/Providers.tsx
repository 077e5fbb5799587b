import { MantineProvider } from "@mantine/core";
import { Notifications } from "@mantine/notifications";
import { MutationCache, QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { type ReactNode, useState } from "react";
import { Router } from "wouter";
import { useHashLocation } from "wouter/use-hash-location";

import { StationError } from "../api/client";
import { LiveProvider } from "../live/hooks";
import { notifyError } from "../ui/notify";
import { theme } from "../ui/theme";

const LOGIN_NEEDED = 401;

/** A mutation that shows its own errors says so in its `meta`. */
function newQueryClient(): QueryClient {
  return new QueryClient({
    defaultOptions: {
      queries: {
        retry: (count, error) => !(error instanceof StationError && error.status >= 400) && count < 3,
        networkMode: "always",
        refetchOnWindowFocus: true,
      },
      mutations: { networkMode: "always", retry: false },
    },
    mutationCache: new MutationCache({
      onError: (error, _variables, _result, mutation) => {
        if (!mutation.meta?.["showsErrors"] || (error instanceof StationError && error.status === LOGIN_NEEDED)) notifyError(error);
      },
    }),
  });
}

export function Providers({ children }: { children: ReactNode }) {
  const [client] = useState(newQueryClient);
  return (
    // Variables and classes come from style sheets: no style elements, so the CSP can stay strict.
    <MantineProvider theme={theme} defaultColorScheme="light" withCssVariables={false} withGlobalClasses={false}>
      <QueryClientProvider client={client}>
        <Router hook={useHashLocation}>
          <LiveProvider>
            <Notifications position="top-center" />
            {children}
          </LiveProvider>
        </Router>
      </QueryClientProvider>
    </MantineProvider>
  );
}
