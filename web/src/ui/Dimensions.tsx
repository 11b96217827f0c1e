// Width, height and depth of the selected part, or of everything, as the sliders move.

import { nameOf } from '../session/document';
import { formatSize, sizeOf } from '../session/measure';
import { compiled, document, selection, step } from '../session/session';

export function Dimensions() {
  step.value; // reads the evaluator below, which is no signal
  const state = compiled.value;
  const { model } = document.value;
  if (state.kind !== 'ready' || model === null) return null;
  const id = selection.value?.part;
  const part = model.shape.parts.findIndex((other) => other.id === id);
  const size = sizeOf(model.shape, state.evaluator, part < 0 ? null : part);
  return (
    <p class="dimensions" title="Width × height × depth">
      {id !== undefined && part >= 0 && <span class="quiet">{nameOf(document.value, id)} </span>}
      {formatSize(size)}
    </p>
  );
}
