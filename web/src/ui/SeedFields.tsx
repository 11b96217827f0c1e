// The fields of a seed edit: what to do with a part, with which feature of it, along what, from where.

import { useId } from 'preact/hooks';
import { directionField, fieldsOf, isGroupOperator } from '../program/operators';
import type { Anchor, LocalTriple, Shape, Statement } from '../program/types';
import { nameOf } from '../session/document';
import { axes, mostAlong } from '../session/measure';
import { document } from '../session/session';
import { m, type Sentence, t } from '../texts/texts';
import { choiceOf, groupOfPart, isWhole, type SeedChoice, seedOf, withPart } from './seed_choice';
import { allFeatures, axisWords, featureKind, featureWords, operatorWords, statementWords } from './words';

const operators = Object.keys(operatorWords) as (keyof typeof operatorWords)[];
const kindsOf = { face: m`Faces`, edge: m`Edges`, corner: m`Corners` } as const;

const countAnchors: readonly [Anchor, Sentence][] = [
  ['middle', m`at both ends`],
  ['start', m`at the last end`],
  ['end', m`at the first end`],
  ['fit', m`within the same space`],
];

interface Props {
  readonly shape: Shape;
  readonly choice: SeedChoice;
  /** The first option of the list of parts. */
  readonly nothing: string;
  readonly onChange: (choice: SeedChoice) => void;
}

/** The fields of several edits, each told once it is whole. */
export function SeedList({
  shape,
  seed,
  onChange,
}: {
  readonly shape: Shape;
  readonly seed: readonly Statement[];
  readonly onChange: (seed: readonly Statement[]) => void;
}) {
  return seed.map((statement, i) => (
    <fieldset key={i} aria-label={statementWords(document.value, statement)}>
      <SeedFields
        shape={shape}
        choice={choiceOf(shape, statement)}
        nothing={t`choose a part…`}
        onChange={(next) => {
          if (isWhole(shape, next)) onChange(seed.with(i, seedOf(shape, next)));
        }}
      />
    </fieldset>
  ));
}

export function SeedFields({ shape, choice, nothing, onChange }: Props) {
  const { op, part, feature, direction, origin, anchor } = choice;
  const group = useId();
  const canBeGroup = groupOfPart(shape, part) !== undefined;
  const fields = isGroupOperator(op) || op === 'keep_fixed' ? {} : fieldsOf(op);
  const needsDirection = directionField(fields) !== undefined;
  const needsOrigin = 'origin' in fields;
  const straight = 'part' in direction ? null : direction.filter((v) => v !== 0).length === 1;
  const ownOrigin = 'part' in origin && (origin.part === part || origin.part === '');
  return (
    <>
      <label>
        <span>{t`Part`}</span>
        <select
          value={part}
          onChange={(event) => onChange(withPart(shape, choice, event.currentTarget.value))}
          aria-label={t`Part to edit`}
        >
          <option value="">{nothing}</option>
          {shape.parts.map(({ id }) => (
            <option key={id} value={id}>
              {nameOf(document.value, id)}
            </option>
          ))}
        </select>
      </label>
      <div class="operators" role="radiogroup" aria-label={t`What to do with it`}>
        {operators.map((id) => (
          <label key={id} class="chip" title={t(operatorWords[id].help)}>
            <input
              type="radio"
              name={`operator ${group}`}
              value={id}
              checked={op === id}
              disabled={isGroupOperator(id) && !canBeGroup}
              onChange={() => onChange({ ...choice, op: id, amount: null, normal: null })}
            />
            <span>{t(operatorWords[id].label)}</span>
          </label>
        ))}
      </div>
      {!isGroupOperator(op) && op !== 'keep_fixed' && (
        <div class="field">
          <span>{t`What`}</span>
          <FeatureSelect
            label={t`The whole part or a face, edge or corner of it`}
            value={feature}
            whole={t`the whole part`}
            onChange={(next) => onChange({ ...choice, feature: next })}
          />
        </div>
      )}
      {needsDirection && (
        <label>
          <span>{'axis' in fields ? t`About` : 'direction' in fields ? t`Along` : t`Across`}</span>
          <select
            aria-label={t`Direction`}
            value={straight && !('part' in direction) ? mostAlong(direction) : 'other'}
            onChange={(event) => {
              const axis = axes[Number(event.currentTarget.value)];
              if (axis !== undefined) onChange({ ...choice, direction: axis, normal: null });
            }}
          >
            {axisWords.map((words, i) => (
              <option key={i} value={i}>
                {t(words)}
              </option>
            ))}
            {!straight && (
              <option value="other">
                {'part' in direction
                  ? t`${t(axisWords[direction.axis])} of ${nameOf(document.value, direction.part)}`
                  : t`at an angle`}
              </option>
            )}
          </select>
        </label>
      )}
      {needsOrigin && (
        <div class="field">
          <span>{t`From`}</span>
          <FeatureSelect
            label={t`Point that stays`}
            value={ownOrigin ? origin.at : null}
            other={
              'part' in origin
                ? t`${featureWords(origin.at)} of ${nameOf(document.value, origin.part)}`
                : t`a point elsewhere`
            }
            whole={t`its centre`}
            onChange={(at) => onChange({ ...choice, origin: { part, at } })}
          />
        </div>
      )}
      {op === 'change_count' && (
        <label>
          <span>{t`Where`}</span>
          <select
            value={anchor}
            onChange={(event) => onChange({ ...choice, anchor: event.currentTarget.value as Anchor })}
          >
            {countAnchors.map(([id, words]) => (
              <option key={id} value={id}>
                {t(words)}
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
      {(['face', 'edge', 'corner'] as const).map((kind) => (
        <optgroup key={kind} label={t(kindsOf[kind])}>
          {allFeatures
            .filter((feature) => featureKind(feature) === kind)
            .map((feature) => (
              <option key={feature.join()} value={feature.join()}>
                {t`its ${featureWords(feature)}`}
              </option>
            ))}
        </optgroup>
      ))}
    </select>
  );
}
