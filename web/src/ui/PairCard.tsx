// What two selected parts are to each other, to be put right: their joint, and whether they are mirror images. And what
// was put right so far.
import type { Shape, ShapePart } from '../program/types';
import { models } from '../session/core';
import { correct, type Pair, pairOf, uncorrect } from '../session/corrections';
import { type Correction, nameOf, noCorrections, partKey } from '../session/document';
import { document, selectAll, selected, task } from '../session/session';
import { Icon } from './Icon';
import { jointWords } from './words';

export function PairCard({ shape }: { shape: Shape }) {
  const pair = pairOf(shape, selected.value, document.value.model?.corrections);
  if (pair === null) return null;
  return (
    <section class="pair" aria-label="Joint">
      <p>{pairWords(pair)}</p>
      <div class="chips">
        {changesOf(pair).map(({ kind, label, title }) => (
          <button
            type="button"
            class="chip-button"
            key={kind}
            title={`${title} Their mirror images, and others in their rows, follow.`}
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
  const held = joint === null ? 'Not joined' : said === 'loose' ? 'Joined loosely' : `Joined ${jointWords(joint)}`;
  return mirror === null ? `${held}.` : `${held}; mirror images.`;
}

interface Change {
  readonly kind: Correction['kind'];
  readonly label: string;
  readonly title: string;
}

function changesOf({ joint, mirror, said }: Pair): readonly Change[] {
  const add: Change = { kind: 'joined', label: 'Add a joint', title: 'They stay together where they are nearest.' };
  const loosen: Change = {
    kind: 'loose',
    label: 'Loosen the joint',
    title: 'Holds them at the middle of where they touch alone: there they may turn and grow.',
  };
  const firm: Change = { kind: 'joined', label: 'Hold the joint firmly', title: 'As it was found.' };
  const remove: Change = {
    kind: 'apart',
    label: 'Remove the joint',
    title: 'They no longer follow each other for it.',
  };
  const joints =
    joint === null ? [add] : said === 'loose' ? [firm, remove] : joint.kind === 'point' ? [remove] : [loosen, remove];
  return [
    ...joints,
    mirror === null
      ? { kind: 'mirrored', label: 'Add a mirror image', title: 'What becomes of the one becomes of the other.' }
      : { kind: 'unmirrored', label: 'Remove the mirror image', title: 'Each may change on its own.' },
  ];
}

const saidWords: Readonly<Record<Correction['kind'], string>> = {
  joined: 'joined',
  loose: 'joined loosely',
  apart: 'not joined',
  mirrored: 'mirror images',
  unmirrored: 'no mirror images',
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
    <section class="relations put-right" aria-label="Put right by hand">
      <h3>Put right by hand</h3>
      <ul>
        {corrections.map((correction) => {
          const ids = correction.parts.map((key) => idOf.get(key) ?? key);
          const [a, b] = ids.map((id) => nameOf(document.value, id));
          const text = `${a} and ${b}: ${saidWords[correction.kind]}`;
          return (
            <li key={text}>
              <button type="button" class="line" title="Selects the two" onClick={() => selectAll(ids)}>
                {text}
              </button>
              <button
                type="button"
                class="button icon-only"
                aria-label={`Take back: ${text}`}
                title="As it was found"
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
          All as found
        </button>
      )}
    </section>
  );
}
