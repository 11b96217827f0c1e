// The fields of a seed edit: what to do with a part, with which feature of it, along what, from where.
import { useId } from 'preact/hooks';
import type { Anchor, LocalTriple, Shape } from '../program/types';
import { nameOf } from '../session/document';
import { axes, mostAlong } from '../session/measure';
import { document } from '../session/session';
import { groupOfPart, isOfGroup, type Operator, type SeedChoice, withPart } from './seed_choice';
import { allFeatures, axisWords, type FeatureKind, featureKind, featureWords } from './words';

export const operators: readonly { readonly id: Operator; readonly label: string; readonly help: string }[] = [
  { id: 'translate', label: 'Move', help: 'Moves it along a direction' },
  { id: 'scale_1d', label: 'Stretch', help: 'Stretches it along one direction' },
  { id: 'scale_2d', label: 'Thicken', help: 'Grows it in the two directions across one' },
  { id: 'scale_3d', label: 'Grow', help: 'Grows it in all directions' },
  { id: 'rotate', label: 'Tilt', help: 'Turns it about an axis' },
  { id: 'shear', label: 'Slant', help: 'Slants it' },
  { id: 'change_count', label: 'Count', help: 'More or fewer of the row' },
  { id: 'change_delta', label: 'Spacing', help: 'Sets the row wider or closer' },
  { id: 'keep_fixed', label: 'Keep', help: 'Keeps it as it is' },
];

const countAnchors: readonly [Anchor, string][] = [
  ['middle', 'at both ends'],
  ['start', 'at the last end'],
  ['end', 'at the first end'],
  ['fit', 'within the same space'],
];

interface Props {
  readonly shape: Shape;
  readonly choice: SeedChoice;
  /** The first option of the list of parts. */
  readonly nothing: string;
  readonly onChange: (choice: SeedChoice) => void;
}

export function SeedFields({ shape, choice, nothing, onChange }: Props) {
  const { op, part, feature, direction, origin, anchor } = choice;
  const group = useId();
  const canBeGroup = groupOfPart(shape, part) !== undefined;
  const needsDirection = ['translate', 'scale_1d', 'scale_2d', 'rotate', 'shear'].includes(op);
  const needsOrigin = ['scale_1d', 'scale_2d', 'scale_3d', 'rotate', 'shear'].includes(op);
  const straight = 'part' in direction ? null : direction.filter((v) => v !== 0).length === 1;
  const ownOrigin = 'part' in origin && (origin.part === part || origin.part === '');
  return (
    <>
      <label>
        <span>Part</span>
        <select
          value={part}
          onChange={(event) => onChange(withPart(shape, choice, event.currentTarget.value))}
          aria-label="Part to edit"
        >
          <option value="">{nothing}</option>
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
              name={`operator ${group}`}
              value={id}
              checked={op === id}
              disabled={isOfGroup(id) && !canBeGroup}
              onChange={() => onChange({ ...choice, op: id, amount: null, normal: null })}
            />
            <span>{label}</span>
          </label>
        ))}
      </div>
      {!isOfGroup(op) && op !== 'keep_fixed' && (
        <div class="field">
          <span>What</span>
          <FeatureSelect
            label="The whole part or a face, edge or corner of it"
            value={feature}
            whole="the whole part"
            onChange={(next) => onChange({ ...choice, feature: next })}
          />
        </div>
      )}
      {needsDirection && (
        <label>
          <span>{op === 'rotate' ? 'About' : op === 'scale_2d' ? 'Across' : 'Along'}</span>
          <select
            aria-label="Direction"
            value={straight && !('part' in direction) ? mostAlong(direction) : 'other'}
            onChange={(event) => {
              const axis = axes[Number(event.currentTarget.value)];
              if (axis !== undefined) onChange({ ...choice, direction: axis, normal: null });
            }}
          >
            {axisWords.map((words, i) => (
              <option key={words} value={i}>
                {words}
              </option>
            ))}
            {!straight && (
              <option value="other">
                {'part' in direction
                  ? `${axisWords[direction.axis]} of ${nameOf(document.value, direction.part)}`
                  : 'at an angle'}
              </option>
            )}
          </select>
        </label>
      )}
      {needsOrigin && (
        <div class="field">
          <span>From</span>
          <FeatureSelect
            label="Point that stays"
            value={ownOrigin ? origin.at : null}
            other={
              'part' in origin
                ? `${featureWords(origin.at)} of ${nameOf(document.value, origin.part)}`
                : 'a point elsewhere'
            }
            whole="its centre"
            onChange={(at) => onChange({ ...choice, origin: { part, at } })}
          />
        </div>
      )}
      {op === 'change_count' && (
        <label>
          <span>Where</span>
          <select
            value={anchor}
            onChange={(event) => onChange({ ...choice, anchor: event.currentTarget.value as Anchor })}
          >
            {countAnchors.map(([id, words]) => (
              <option key={id} value={id}>
                {words}
              </option>
            ))}
          </select>
        </label>
      )}
    </>
  );
}

interface FeatureSelectProps {
  readonly label: string;
  /** Null: what `other` says. */
  readonly value: LocalTriple | null;
  readonly other?: string;
  readonly whole: string;
  readonly onChange: (feature: LocalTriple) => void;
}

function FeatureSelect({ label, value, other, whole, onChange }: FeatureSelectProps) {
  const kinds: readonly FeatureKind[] = ['face', 'edge', 'corner'];
  return (
    <select
      aria-label={label}
      value={value === null ? 'other' : value.join()}
      onChange={(event) => {
        if (event.currentTarget.value === 'other') return;
        onChange(event.currentTarget.value.split(',').map(Number) as unknown as LocalTriple);
      }}
    >
      {value === null && <option value="other">{other}</option>}
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
