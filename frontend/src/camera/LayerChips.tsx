import { LAYERS, type Layers } from "./overlay";
import css from "./camera.module.css";

/** Switches for what is drawn over the picture. */
export function LayerChips({ layers, onChange }: { layers: Layers; onChange: (layers: Layers) => void }) {
  return (
    <div className={css.chips} role="group" aria-label="Layers over the picture">
      {LAYERS.map(({ name, word }) => (
        <button key={name} type="button" className={css.chip} aria-pressed={layers[name]} onClick={() => onChange({ ...layers, [name]: !layers[name] })}>
          {word}
        </button>
      ))}
    </div>
  );
}
