import react from "@vitejs/plugin-react";
import { defineConfig } from "vitest/config";

const STATION = process.env.ROWPILOT_STATION ?? "http://127.0.0.1:8000";

export default defineConfig({
  plugins: [react()],
  build: {
    outDir: "../backend/static",
    emptyOutDir: true,
    // No data: URLs and no inlined module preload: the station's CSP allows scripts and styles from itself only.
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1500,
  },
  server: {
    proxy: {
      "/api": { target: STATION, ws: true },
      "/enter": STATION,
      "/scene": { target: STATION, ws: true },
    },
  },
  test: { environment: "node", include: ["src/**/*.test.ts"] },
});
