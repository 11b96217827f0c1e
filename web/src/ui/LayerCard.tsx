// One edit as a card: its request, its slider, what it keeps, and on demand every statement with its why.

import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import type { Statement } from '../program/types';
import type { LayerEntry } from '../session/document';
import { misfit } from '../session/evaluation';
import { titleOf } from '../session/layers';
import { duplicateLayer } from '../session/page_cards';
import { playing, playOn, stop } from '../session/play';
import { document, moveLayer, pointedAt, removeLayer, renameLayer, setEnabled } from '../session/session';
import { plural, t } from '../texts/texts';
import { showText } from './actions';
import { FoldButton, GroupField } from './CardParts';
import { ChangeCard, OtherCount } from './ChangeCard';
import { folded } from './folds';
import { Icon } from './Icon';
import { Menu } from './Menu';
import { showReadings } from './readings';
import { ValueSlider } from './ValueSlider';
import { brokenWords, inWords, whyNothingElse } from './why';
import { capital, groupMembers, keptWords, relationWords, sideName, statementWords, whyWords } from './words';

interface CardProps {
  readonly entry: LayerEntry;
  readonly first: boolean;
  readonly last: boolean;
  /** A viewer has the slider only. */
  readonly plain?: boolean;
}

export function LayerCard({ entry, first, last, plain = false }: CardProps) {
  const { key, layer, enabled } = entry;
  const renaming = useSignal(false);
  const grouping = useSignal(false);
  const changing = useSignal(false);
  const isPlaying = playing.value === key;
  const title = titleOf(layer);
  const shape = document.value.model?.shape;
  const unfit = shape ? misfit(shape, layer) : null;
  return (
    <li class={`card ${enabled && unfit === null ? '' : 'off'}`} aria-label={title}>
      <header>
        {!plain && <FoldButton id={key} title={title} />}
        {renaming.value ? <RenameField entry={entry} done={() => (renaming.value = false)} /> : <h3>{title}</h3>}
        <button
          type="button"
          class="button icon-only"
          aria-label={isPlaying ? t`Stop ${title}` : t`Animate ${title}`}
          title={isPlaying ? t`Stop` : t`Animate`}
          aria-disabled={!enabled || unfit !== null}
          onClick={() => {
            if (isPlaying) stop();
            else if (enabled && unfit === null) playOn(key);
          }}
        >
          <Icon name={isPlaying ? 'pause' : 'play'} />
        </button>
        {!plain && (
          <Menu
            label={t`More about ${title}`}
            class="button icon-only"
            items={[
              { label: t`Rename`, act: () => (renaming.value = true) },
              { label: t`Other readings`, disabled: layer.request === '', act: () => showReadings(entry) },
              { label: t`Change…`, disabled: unfit !== null, act: () => (changing.value = true) },
              { label: t`Duplicate`, disabled: unfit !== null, act: () => duplicateLayer(key) },
              { label: entry.group ? t`Other group…` : t`Group…`, act: () => (grouping.value = true) },
              { label: t`Show as text`, act: () => showText(key) },
              { label: enabled ? t`Switch off` : t`Switch on`, act: () => setEnabled(key, !enabled) },
              { label: t`Move up`, disabled: first, act: () => moveLayer(key, -1) },
              { label: t`Move down`, disabled: last, act: () => moveLayer(key, 1) },
              { label: t`Remove`, act: () => removeLayer(key) },
            ]}
          >
            <Icon name="more" />
          </Menu>
        )}
      </header>
      {grouping.value && <GroupField entry={entry} done={() => (grouping.value = false)} />}
      {!plain && folded.value.has(key) ? null : <Body entry={entry} plain={plain} unfit={unfit} />}
      {changing.value && <ChangeCard entry={entry} done={() => (changing.value = false)} />}
    </li>
  );
}

function Body({ entry, plain, unfit }: { entry: LayerEntry; plain: boolean; unfit: string | null }) {
  const { layer, enabled } = entry;
  return (
    <>
      {unfit === null ? (
        <ValueSlider entry={entry} />
      ) : (
        <p class="unfit">
          <Icon name="warning" />
          <span>
            {t`Rests, since it does not fit the parts as they are labelled now.`} <span class="quiet">{unfit}</span>
          </span>
        </p>
      )}
      {!enabled && <p class="quiet">{t`Switched off`}</p>}
      {!plain && entry.seen && <p class="quiet">{t`Its sides were said looking at its ${sideName(entry.seen)}`}</p>}
      {!plain && unfit === null && <Status entry={entry} />}
      {!plain && unfit === null && <OtherCount entry={entry} />}
      {!plain && <Statements statements={layer.statements} />}
    </>
  );
}

function RenameField({ entry, done }: { entry: LayerEntry; done: () => void }) {
  const cancelled = useRef(false);
  return (
    <input
      class="rename"
      value={entry.layer.request}
      maxLength={400}
      aria-label={t`Name of the edit`}
      ref={(element) => element?.focus()}
      onBlur={(event) => {
        done();
        if (!cancelled.current) renameLayer(entry.key, event.currentTarget.value.trim());
      }}
      onKeyDown={(event) => {
        cancelled.current = event.key === 'Escape';
        if (event.key === 'Enter' || event.key === 'Escape') event.currentTarget.blur();
      }}
    />
  );
}

const point = (parts: readonly string[], relations: readonly string[]) => {
  const show = () => {
    pointedAt.value = { parts, relations };
  };
  const hide = () => {
    pointedAt.value = null;
  };
  return { onPointerEnter: show, onPointerLeave: hide, onFocus: show, onBlur: hide };
};

/** What the edit keeps and gives up: quiet when all is held, amber with the reason when not. */
function Status({ entry }: { entry: LayerEntry }) {
  const { layer, trace } = entry;
  const reports = layer.relations;
  const { model } = document.value;
  const kept = keptWords(reports);
  if (model === null) return null;
  if (kept === '') {
    return model.shape.relations.length > 0 ? (
      <p class="quiet">{t`Written by hand: what it keeps was not worked out.`}</p>
    ) : null;
  }
  const alone = whyNothingElse(entry);
  const notable = reports.filter(({ status }) => status !== 'held');
  const broken = notable.some(({ status }) => status === 'broken');
  const sampled = reports.filter(({ status, proof }) => status === 'held' && proof === 'sampled').length;
  return (
    <div class="status">
      <p class={broken ? 'broken' : 'held'}>
        <Icon name={broken ? 'warning' : 'check'} />
        <span>
          {kept}
          <span class="quiet">
            {' · '}
            {sampled === 0 ? t`proved` : t`${sampled} sampled, the others proved`}
          </span>
        </span>
      </p>
      {notable.length > 0 && (
        <ul>
          {notable.map((report) => {
            const relation = model.shape.relations.find(({ id }) => id === report.id);
            if (relation === undefined) return null;
            const text =
              report.status === 'disabled'
                ? t`ignored, as asked`
                : brokenWords(document.value, layer, relation, report);
            return (
              <li key={report.id}>
                <button type="button" class={`line ${report.status}`} {...point(relation.parts, [relation.id])}>
                  {relationWords(document.value, relation)}: <span>{text}</span>
                </button>
              </li>
            );
          })}
        </ul>
      )}
      {alone && <p class="quiet">{alone}</p>}
      {trace?.notes.map((note) => (
        <p class="quiet" key={note}>
          {capital(inWords(document.value, note))}.
        </p>
      ))}
    </div>
  );
}

function Statements({ statements }: { statements: readonly Statement[] }) {
  return (
    <details class="statements">
      <summary>{plural(statements.length, '{n} statement', '{n} statements')}</summary>
      <ol>
        {statements.map((statement, i) => (
          <StatementLine key={i} statement={statement} />
        ))}
      </ol>
    </details>
  );
}

function StatementLine({ statement }: { statement: Statement }) {
  const open = useSignal(false);
  const why = whyWords(document.value, statement);
  const parts = 'part' in statement ? [statement.part] : groupMembers(document.value, statement.relation);
  return (
    <li>
      <button
        type="button"
        class="line"
        aria-expanded={open.value}
        onClick={() => {
          open.value = !open.value;
        }}
        {...point(parts, statement.why?.relations ?? [])}
      >
        {statementWords(document.value, statement)}
        {why && <span class="quiet">, {why}</span>}
      </button>
      {open.value && <code class="formula">{formula(statement)}</code>}
    </li>
  );
}

/** The statement as it is written, complete. */
function formula(statement: Statement): string {
  const { op, why, ...fields } = statement;
  const text = Object.entries(fields).map(([name, value]) => `${name}: ${JSON.stringify(value).replaceAll('"', '')}`);
  const reason = why && why.relations.length > 0 ? `\n${t`because of ${why.relations.join(', ')}`}` : '';
  return `${op}\n${text.join('\n')}${reason}`;
}
