// What two selected parts are to each other, to be put right: their joint, and whether they are mirror images. And what
// was put right so far.

import type { Shape, ShapePart } from '../program/types';
import { models } from '../session/core';
import { correct, type Pair, pairOf, uncorrect } from '../session/corrections';
import { type Correction, nameOf, noCorrections, partKey } from '../session/document';
import { document, selectAll, selected, task } from '../session/session';
import { m, type Sentence, t } from '../texts/texts';
import { Icon } from './Icon';
import { jointWords } from './words';

export function PairCard({ shape }: { shape: Shape }) {
  const pair = pairOf(shape, selected.value, document.value.model?.corrections);
  if (pair === null) return null;
  return (
    <section class="pair" aria-label={t`Joint`}>
      <p>{pairWords(pair)}</p>
      <div class="chips">
        {changesOf(pair).map(({ kind, label, title }) => (
          <button
            type="button"
            class="chip-button"
            key={kind}
            title={t`${title} Their mirror images, and others in their rows, follow.`}
            disabled={models.value === null || task.value !== null}
            onClick={() => void declare(pair, kind)}
          >
            {label}
          </button>
        ))}
      </div>
    </section>
  );
}

/** The same two stay selected, whatever they are called then. */
async function declare(pair: Pair, kind: Correction['kind']): Promise<void> {
  if (models.value === null) return;
  const before = document.peek().model?.shape.parts ?? [];
  const keys = pair.ids.map((id) => keyOf(before, id));
  if (!(await correct(models.value, { kind, parts: pair.keys }))) return;
  const now = document.peek().model?.shape.parts ?? [];
  const again = keys.flatMap((key) => now.find(({ id }) => keyOf(now, id) === key)?.id ?? []);
  if (again.length === keys.length) selectAll(again);
}

/** What stays the same when ids change. */
function keyOf(parts: readonly ShapePart[], id: string): string {
  const part = parts.find((other) => other.id === id);
  if (part === undefined) return '';
  return part.virtual ? part.members.map((member) => keyOf(parts, member)).join(' ') : partKey(part);
}

function pairWords({ joint, mirror, said }: Pair): string {
  const held = joint === null ? t`Not joined` : said === 'loose' ? t`Joined loosely` : t`Joined ${jointWords(joint)}`;
  return mirror === null ? `${held}.` : t`${held}; mirror images.`;
}

interface Change {
  readonly kind: Correction['kind'];
  readonly label: string;
  readonly title: string;
}

function changesOf({ joint, mirror, said }: Pair): readonly Change[] {
  const add: Change = { kind: 'joined', label: t`Add a joint`, title: t`They stay together where they are nearest.` };
  const loosen: Change = {
    kind: 'loose',
    label: t`Loosen the joint`,
    title: t`Holds them at the middle of where they touch alone: there they may turn and grow.`,
  };
  const firm: Change = { kind: 'joined', label: t`Hold the joint firmly`, title: t`As it was found.` };
  const remove: Change = {
    kind: 'apart',
    label: t`Remove the joint`,
    title: t`They no longer follow each other for it.`,
  };
  const joints =
    joint === null ? [add] : said === 'loose' ? [firm, remove] : joint.kind === 'point' ? [remove] : [loosen, remove];
  return [
    ...joints,
    mirror === null
      ? { kind: 'mirrored', label: t`Add a mirror image`, title: t`What becomes of the one becomes of the other.` }
      : { kind: 'unmirrored', label: t`Remove the mirror image`, title: t`Each may change on its own.` },
  ];
}

const saidWords: Readonly<Record<Correction['kind'], Sentence>> = {
  joined: m`joined`,
  loose: m`joined loosely`,
  apart: m`not joined`,
  mirrored: m`mirror images`,
  unmirrored: m`no mirror images`,
};

/** What was put right by hand, with a way back. */
export function CorrectionList() {
  const { model } = document.value;
  const corrections = model?.corrections ?? noCorrections;
  if (model === null || corrections.length === 0) return null;
  const idOf = new Map(model.shape.parts.map((part) => [partKey(part), part.id]));
  const isOff = models.value === null || task.value !== null;
  const back = (gone: Correction | null) => {
    if (models.value !== null) void uncorrect(models.value, gone);
  };
  return (
    <section class="relations put-right" aria-label={t`Put right by hand`}>
      <h3>{t`Put right by hand`}</h3>
      <ul>
        {corrections.map((correction) => {
          const ids = correction.parts.map((key) => idOf.get(key) ?? key);
          const [a, b] = ids.map((id) => nameOf(document.value, id));
          const text = t`${a ?? ''} and ${b ?? ''}: ${t(saidWords[correction.kind])}`;
          return (
            <li key={text}>
              <button type="button" class="line" title={t`Selects the two`} onClick={() => selectAll(ids)}>
                {text}
              </button>
              <button
                type="button"
                class="button icon-only"
                aria-label={t`Take back: ${text}`}
                title={t`As it was found`}
                disabled={isOff}
                onClick={() => back(correction)}
              >
                <Icon name="close" />
              </button>
            </li>
          );
        })}
      </ul>
      {corrections.length > 1 && (
        <button type="button" class="chip-button" disabled={isOff} onClick={() => back(null)}>
          {t`All as found`}
        </button>
      )}
    </section>
  );
}
