// An edit by hand: a part or one of its faces, edges and corners, an operator, what the others should do, and which
// relations may give way. Propagation finds the rest and leaves a layer with a slider.
import { type Signal, useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { LocalTriple, Statement, Vec3 } from '../program/types';
import { isGroup, type Shape } from '../program/types';
import { models } from '../session/core';
import { type EditInput, type Hint, hints, nameOf } from '../session/document';
import { playOnce } from '../session/play';
import { document, propagate, select, selection, task } from '../session/session';
import { Icon } from './Icon';
import { allFeatures, axisWords, type FeatureKind, featureKind, featureWords, hintWords, relationWords } from './words';

const operators = [
  { id: 'translate', label: 'Move', help: 'Moves it along a direction' },
  { id: 'scale_1d', label: 'Stretch', help: 'Stretches it along one direction' },
  { id: 'scale_2d', label: 'Thicken', help: 'Grows it in the two directions across one' },
  { id: 'scale_3d', label: 'Grow', help: 'Grows it in all directions' },
  { id: 'rotate', label: 'Tilt', help: 'Turns it about an axis' },
  { id: 'shear', label: 'Slant', help: 'Slants it' },
  { id: 'change_count', label: 'Count', help: 'More or fewer of the row' },
  { id: 'change_delta', label: 'Spacing', help: 'Sets the row wider or closer' },
  { id: 'keep_fixed', label: 'Keep', help: 'Keeps it as it is' },
] as const;
type Operator = (typeof operators)[number]['id'];

/** Along + of each axis: to its left, up, forwards. */
const axes: readonly Vec3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Which kind of feature a click in the view selects while this panel is open; null when it is closed. */
export function HandPanel({ pickKind, onDone }: { pickKind: Signal<FeatureKind | null>; onDone: () => void }) {
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.scrollIntoView({ block: 'nearest' }), []);
  const operator = useSignal<Operator>('translate');
  const axis = useSignal(0);
  const origin = useSignal<LocalTriple>([0, 0, 0]);
  const anchor = useSignal<'middle' | 'start' | 'end' | 'fit'>('middle');
  const chosenHints = useSignal<ReadonlyMap<string, Hint>>(new Map());
  const disabled = useSignal<ReadonlySet<string>>(new Set());
  const { model } = document.value;
  if (model === null) return null;
  const { shape } = model;
  const part = shape.parts.find(({ id }) => id === selection.value?.part);
  const feature = selection.value?.feature ?? [0, 0, 0];
  const group = part && shape.relations.find((r) => isGroup(r) && (r.parent === part.id || r.parts.includes(part.id)));
  const needsGroup = operator.value === 'change_count' || operator.value === 'change_delta';
  const needsAxis = ['translate', 'scale_1d', 'scale_2d', 'rotate', 'shear'].includes(operator.value);
  const needsOrigin = ['scale_1d', 'scale_2d', 'scale_3d', 'rotate', 'shear'].includes(operator.value);
  const ready = part !== undefined && (!needsGroup || group !== undefined) && models.value !== null && !task.value;

  const apply = async () => {
    if (part === undefined || models.value === null || !ready) return;
    const direction = axes[axis.value] ?? [1, 0, 0];
    const seed = seedOf(operator.value, part.id, feature, direction, origin.value, anchor.value, group?.id ?? '');
    const edit: EditInput = {
      seed: [seed],
      disabled: [...disabled.value],
      hints: Object.fromEntries(chosenHints.value),
    };
    const label = operators.find(({ id }) => id === operator.value)?.label ?? '';
    const what = featureKind(feature) === 'whole' || needsGroup ? '' : ` ${featureWords(feature)} of`;
    const key = await propagate(models.value, edit, `${label}${what} ${nameOf(document.peek(), part.id)}`);
    if (key === null) return;
    onDone();
    playOnce(key);
  };

  return (
    <form
      ref={form}
      class="hand"
      aria-label="Edit by hand"
      onSubmit={(event) => {
        event.preventDefault();
        void apply();
      }}
    >
      <label>
        <span>Part</span>
        <select
          value={part?.id ?? ''}
          onChange={(event) => select(event.currentTarget.value || null)}
          aria-label="Part to edit"
        >
          <option value="">click one in the view…</option>
          {shape.parts.map(({ id }) => (
            <option key={id} value={id}>
              {nameOf(document.value, id)}
            </option>
          ))}
        </select>
      </label>
      <div class="operators" role="radiogroup" aria-label="What to do with it">
        {operators.map(({ id, label, help }) => (
          <label key={id} class="chip" title={help}>
            <input
              type="radio"
              name="operator"
              value={id}
              checked={operator.value === id}
              disabled={(id === 'change_count' || id === 'change_delta') && group === undefined}
              onChange={() => {
                operator.value = id;
              }}
            />
            <span>{label}</span>
          </label>
        ))}
      </div>
      {!needsGroup && operator.value !== 'keep_fixed' && (
        <div class="field">
          <span>Of it</span>
          <FeatureSelect
            label="The whole part or a face, edge or corner of it"
            value={feature}
            whole="the whole part"
            onChange={(next) => {
              pickKind.value = featureKind(next);
              if (part) select(part.id, next);
            }}
          />
        </div>
      )}
      {needsAxis && (
        <label>
          <span>{operator.value === 'rotate' ? 'About' : operator.value === 'scale_2d' ? 'Across' : 'Along'}</span>
          <select
            aria-label="Direction"
            value={axis.value}
            onChange={(event) => {
              axis.value = Number(event.currentTarget.value);
            }}
          >
            {axisWords.map((words, i) => (
              <option key={words} value={i}>
                {words}
              </option>
            ))}
          </select>
        </label>
      )}
      {needsOrigin && (
        <div class="field">
          <span>From</span>
          <FeatureSelect
            label="Point that stays"
            value={origin.value}
            whole="its centre"
            onChange={(next) => {
              origin.value = next;
            }}
          />
        </div>
      )}
      {operator.value === 'change_count' && (
        <label>
          <span>Where</span>
          <select
            value={anchor.value}
            onChange={(event) => {
              anchor.value = event.currentTarget.value as 'middle';
            }}
          >
            <option value="middle">at both ends</option>
            <option value="start">at the last end</option>
            <option value="end">at the first end</option>
            <option value="fit">within the same space</option>
          </select>
        </label>
      )}
      <Hints shape={shape} except={part?.id ?? ''} chosen={chosenHints} />
      {part && <Disabled shape={shape} part={part.id} disabled={disabled} />}
      <div class="row">
        <button type="submit" class="button primary" disabled={!ready}>
          Propagate
        </button>
        <button type="button" class="button" onClick={onDone}>
          Cancel
        </button>
      </div>
    </form>
  );
}

function seedOf(
  op: Operator,
  part: string,
  feature: LocalTriple,
  direction: Vec3,
  at: LocalTriple,
  anchor: 'middle' | 'start' | 'end' | 'fit',
  relation: string,
): Statement {
  const amount = 'x';
  const origin = { part, at };
  switch (op) {
    case 'translate':
      return { op, part, feature, direction, amount };
    case 'rotate':
      return { op, part, feature, origin, axis: direction, amount };
    case 'scale_1d':
      return { op, part, feature, origin, direction, amount };
    case 'scale_2d':
      return { op, part, feature, origin, normal: direction, amount };
    case 'scale_3d':
      return { op, part, feature, origin, amount };
    case 'shear': {
      // Slants along the direction, more so higher up; what slants upwards does so from front to back.
      const normal: Vec3 = direction[1] === 0 ? [0, 1, 0] : [0, 0, 1];
      return { op, part, feature, origin, normal, direction, amount };
    }
    case 'keep_fixed':
      return { op, part };
    // x is about ±0.35 and a count is rounded down: whole instances need a larger factor
    case 'change_count':
      return { op, relation, anchor, amount: '10*x' };
    case 'change_delta':
      return { op, relation, anchor: 'middle', amount };
  }
}

interface FeatureSelectProps {
  readonly label: string;
  readonly value: LocalTriple;
  readonly whole: string;
  readonly onChange: (feature: LocalTriple) => void;
}

function FeatureSelect({ label, value, whole, onChange }: FeatureSelectProps) {
  const kinds: readonly FeatureKind[] = ['face', 'edge', 'corner'];
  return (
    <select
      aria-label={label}
      value={value.join()}
      onChange={(event) => onChange(event.currentTarget.value.split(',').map(Number) as unknown as LocalTriple)}
    >
      <option value="0,0,0">{whole}</option>
      {kinds.map((kind) => (
        <optgroup key={kind} label={`${kind.charAt(0).toUpperCase()}${kind.slice(1)}s`}>
          {allFeatures
            .filter((feature) => featureKind(feature) === kind)
            .map((feature) => (
              <option key={feature.join()} value={feature.join()}>
                its {featureWords(feature)}
              </option>
            ))}
        </optgroup>
      ))}
    </select>
  );
}

export function Hints({
  shape,
  except,
  chosen,
}: {
  shape: Shape;
  except: string;
  chosen: { value: ReadonlyMap<string, Hint> };
}) {
  const free = shape.parts.filter(({ id }) => id !== except && !chosen.value.has(id));
  const set = (id: string, hint: Hint | null) => {
    const next = new Map(chosen.value);
    if (hint === null) next.delete(id);
    else next.set(id, hint);
    chosen.value = next;
  };
  return (
    <details>
      <summary>What other parts should do{chosen.value.size > 0 && ` · ${chosen.value.size}`}</summary>
      {[...chosen.value].map(([id, hint]) => (
        <div class="row" key={id}>
          <span class="grow">{nameOf(document.value, id)}</span>
          <select
            aria-label={`What ${nameOf(document.value, id)} should do`}
            value={hint}
            onChange={(event) => set(id, event.currentTarget.value as Hint)}
          >
            {hints.map((kind) => (
              <option key={kind} value={kind}>
                {hintWords[kind]}
              </option>
            ))}
          </select>
          <button
            type="button"
            class="button icon-only"
            aria-label={`Forget ${nameOf(document.value, id)}`}
            onClick={() => set(id, null)}
          >
            <Icon name="close" />
          </button>
        </div>
      ))}
      <select
        aria-label="Add a part"
        value=""
        onChange={(event) => {
          if (event.currentTarget.value) set(event.currentTarget.value, 'keep_fixed');
        }}
      >
        <option value="">add a part…</option>
        {free.map(({ id }) => (
          <option key={id} value={id}>
            {nameOf(document.value, id)}
          </option>
        ))}
      </select>
    </details>
  );
}

function Disabled({ shape, part, disabled }: { shape: Shape; part: string; disabled: Signal<ReadonlySet<string>> }) {
  const kinds = [
    ['kind:reflection', 'all mirror symmetries'],
    ['kind:translation', 'all even rows'],
    ['kind:rotation', 'all rings'],
  ] as const;
  const own = shape.relations.filter(({ parts }) => parts.includes(part));
  const items = [
    ...kinds.filter(([kind]) => shape.relations.some((relation) => `kind:${relation.kind}` === kind)),
    ...own.map((relation) => [relation.id, relationWords(document.value, relation, part)] as const),
  ];
  return (
    <details>
      <summary>What may come apart{disabled.value.size > 0 && ` · ${disabled.value.size}`}</summary>
      {items.map(([id, words]) => (
        <label class="check" key={id}>
          <input
            type="checkbox"
            checked={disabled.value.has(id)}
            onChange={(event) => {
              const next = new Set(disabled.value);
              if (event.currentTarget.checked) next.add(id);
              else next.delete(id);
              disabled.value = next;
            }}
          />
          <span>{words}</span>
        </label>
      ))}
    </details>
  );
}
