// What can be done with the cards as a whole: presets, groups, copies, all sliders back, the unit of lengths.
import { t } from '../texts/texts';
import { type Document, type LayerEntry, type LengthUnit, nameLimit, type Preset } from './document';
import type { Session } from './session';

export interface Cards {
  /** Another slider for the same edit, at rest, right behind it; answers its key, or null when it does not fit. */
  duplicateLayer(key: number): number | null;
  /** Puts every slider to 0. */
  resetAll(): void;
  /** Null takes the card out of its group. A blank name does as well. */
  setGroup(key: number, group: string | null): void;
  /** Keeps where all sliders stand under a name; a preset of that name is replaced. Nothing for a blank name. */
  savePreset(name: string): void;
  applyPreset(name: string): void;
  removePreset(name: string): void;
  /** Null: whichever unit suits a length. */
  setUnit(unit: LengthUnit | null): void;
}

export const mostPresets = 100;

export function createCards({ change, document, entriesOf, sliderValue }: Session): Cards {
  const withValues = (label: string, valueFor: (entry: LayerEntry) => number) => {
    const before = document.peek();
    const layers = before.layers.map((entry) => {
      const { min, max } = entry.layer.parameter;
      const value = Math.min(max, Math.max(min, valueFor(entry)));
      return value === entry.value ? entry : { ...entry, value };
    });
    if (layers.some((entry, i) => entry !== before.layers[i])) change(label, (now) => ({ ...now, layers }));
  };
  const withPresets = (label: string, edit: (presets: readonly Preset[]) => readonly Preset[]) =>
    change(label, (now) => ({ ...now, presets: edit(now.presets ?? []) }));

  return {
    duplicateLayer(key) {
      const { layers, model } = document.peek();
      const at = layers.findIndex((entry) => entry.key === key);
      const entry = layers[at];
      if (entry === undefined || model === null) return null;
      const { name, sha256 } = model.shape;
      const layer = { ...entry.layer, parameter: { ...entry.layer.parameter, value: 0 } };
      const [copy] =
        entriesOf({
          program: { format: 'parsel/program', version: 1, shape: { name, sha256 }, layers: [layer] },
          ...(entry.trace === undefined ? {} : { trace: entry.trace }),
        }) ?? [];
      if (copy === undefined) return null;
      const grouped = entry.group === undefined ? copy : { ...copy, group: entry.group };
      change(t`duplicate edit`, (now) => ({ ...now, layers: now.layers.toSpliced(at + 1, 0, grouped) }));
      return copy.key;
    },
    resetAll: () => withValues(t`reset all sliders`, () => 0),
    setGroup(key, group) {
      const name = group?.trim().slice(0, nameLimit) || null;
      change(name === null ? t`take out of its group` : t`group “${name}”`, (now) => ({
        ...now,
        layers: now.layers.map((entry) => {
          if (entry.key !== key) return entry;
          const { group: _, ...rest } = entry;
          return name === null ? rest : { ...rest, group: name };
        }),
      }));
    },
    savePreset(given) {
      const name = given.trim().slice(0, nameLimit);
      if (name === '') return;
      const values = new Map(document.peek().layers.map((entry) => [entry.key, sliderValue(entry)]));
      withPresets(t`preset “${name}”`, (presets) =>
        [...presets.filter((preset) => preset.name !== name), { name, values }].slice(-mostPresets),
      );
    },
    applyPreset(name) {
      const preset = document.peek().presets?.find((other) => other.name === name);
      if (preset === undefined) return;
      withValues(t`preset “${name}”`, (entry) => preset.values.get(entry.key) ?? entry.value);
    },
    removePreset(name) {
      withPresets(t`remove preset`, (presets) => presets.filter((preset) => preset.name !== name));
    },
    setUnit(unit) {
      change(unit === null ? t`unit of lengths` : t`lengths in ${unit}`, (now): Document => {
        const { unit: _, ...rest } = now;
        return unit === null ? rest : { ...rest, unit };
      });
    },
  };
}
