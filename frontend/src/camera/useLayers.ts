import { useLocalStorage } from "@mantine/hooks";

import { FIRST_LAYERS, type Layers } from "./overlay";

/** The operator's choice of layers, kept in this browser. */
export function useLayers(): [Layers, (layers: Layers) => void] {
  const [layers, setLayers] = useLocalStorage<Layers>({ key: "rowpilot.layers", defaultValue: FIRST_LAYERS, getInitialValueInEffect: false });
  return [{ ...FIRST_LAYERS, ...layers }, setLayers];
}
