import { useLocalStorage } from "@mantine/hooks";

import { ALL_LAYERS, type Layers } from "./overlay";

/** The operator's choice of layers, kept in this browser. */
export function useLayers(): [Layers, (layers: Layers) => void] {
  const [layers, setLayers] = useLocalStorage<Layers>({ key: "rowpilot.layers", defaultValue: ALL_LAYERS, getInitialValueInEffect: false });
  return [{ ...ALL_LAYERS, ...layers }, setLayers];
}
