// Why a slider goes no further, where it stands at an end.
import type { LayerEntry } from '../session/document';

/** A clause of the core's, with ids; null anywhere else, where the end is far enough, and where nobody knows. */
export function reasonOfEnd({ layer, trace }: Pick<LayerEntry, 'layer' | 'trace'>, value: number): string | null {
  const { min, max } = layer.parameter;
  const reason = value >= max ? trace?.ends?.max : value <= min ? trace?.ends?.min : undefined;
  return reason === undefined || reason === '' || reason === 'limit' ? null : reason;
}
