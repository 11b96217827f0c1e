// The page's end of filling gaps by surfaces built anew: a worker for one question, ended when it is answered or cancelled.
import { isAttachment, type Program, type Shape } from '../program/types';
import { m, type Sentence, t } from '../texts/texts';
import type { FillReply, FillRequest } from '../worker/fill.worker';
import { askOnce } from '../worker/once';
import type { LengthUnit } from './document';
import { FileError } from './files';
import { formatMeasure } from './measure';
import type { RunOptions } from './tasks';

const create = (name: string) =>
  new Worker(new URL('../worker/fill.worker.ts', import.meta.url), { type: 'module', name });

/** Real parts, and which of them are attached; without rows whose number the program changes. */
function joints(shape: Shape, program: Program): Pick<FillRequest, 'parts' | 'pairs'> {
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const numbers = new Map(real.map(({ id }, i) => [id, i]));
  const recounted = new Set(
    program.layers.flatMap(({ statements }) =>
      statements.flatMap((statement) => (statement.op === 'change_count' ? [statement.relation] : [])),
    ),
  );
  const moving = new Set(shape.relations.flatMap(({ id, parts }) => (recounted.has(id) ? parts : [])));
  const pairs = shape.relations.flatMap((relation): [number, number][] => {
    if (!isAttachment(relation) || relation.parts.some((part) => moving.has(part))) return [];
    const [a, b] = relation.parts.map((part) => numbers.get(part));
    return a === undefined || b === undefined ? [] : [[a, b]];
  });
  return { parts: real.map(({ node, primitive }) => ({ node, primitive })), pairs };
}

export interface Filling {
  readonly glb: Uint8Array;
  /** What was filled in and what is open still, in sentences; empty where no gap was left. */
  readonly said: string;
}

/**
 * An exported file with the gaps filled that are left between the surfaces of attached parts.
 * @param rest the model's file before `program`
 * @param unit of lengths; absent: whichever suits each
 */
export async function filledGaps(
  rest: Uint8Array,
  edited: Uint8Array,
  shape: Shape,
  program: Program,
  unit: LengthUnit | undefined,
  options: RunOptions,
): Promise<Filling> {
  const request: FillRequest = { rest, edited, ...joints(shape, program) };
  const reply = await askOnce<FillReply>(create, request, {
    ...options,
    unstarted: t`What fills gaps did not start. Reload the page, with a network the first time.`,
    ended: t`The browser ended what fills gaps: the parts may have too many triangles. Export the gaps closed only.`,
  });
  if ('error' in reply) throw new FileError(t`The gaps could not be filled: ${reply.error}`);
  return { glb: reply.glb, said: sentences(reply, shape, unit) };
}

const mostNamed = 3;

const reasons: Readonly<Record<Exclude<FillReply['gaps'][number]['left'], ''>, Sentence>> = {
  'they are too far apart': m`they are too far apart`,
  'nothing of one faces the other': m`nothing of one faces the other`,
  'what was built anew does not reach across': m`what was built anew does not reach across`,
  'one is not there any more': m`one is not there any more`,
  'one bends with a skeleton': m`one bends with a skeleton`,
  'one has morph targets': m`one has morph targets`,
  'one is drawn many times by one node': m`one is drawn many times by one node`,
};

function sentences({ gaps, lost }: FillReply, shape: Shape, unit: LengthUnit | undefined): string {
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const name = (part: number) => real[part]?.name ?? t`a part`;
  const named = ({ parts: [a, b], width, left }: FillReply['gaps'][number]) => {
    const metres = width / 1000;
    const length = formatMeasure('distance', metres, metres, unit);
    return t`${name(a)} and ${name(b)} (${left === '' ? length : `${length}: ${t(reasons[left])}`})`;
  };
  const listed = (items: readonly string[]) =>
    [...items.slice(0, mostNamed), ...(items.length > mostNamed ? [t`${items.length - mostNamed} more`] : [])].join(
      ', ',
    );
  const filled = gaps.filter(({ left }) => left === '').map(named);
  const open = gaps.filter(({ left }) => left !== '').map(named);
  return [
    filled.length > 0 ? t`Filled between ${listed(filled)}.` : '',
    open.length > 0 ? t`Not filled: ${listed(open)}.` : '',
    lost.length > 0 ? t`Not kept, because it is not known here: ${lost.join(', ')}.` : '',
  ]
    .filter(Boolean)
    .join(' ');
}
