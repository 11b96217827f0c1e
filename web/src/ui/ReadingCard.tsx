// What was understood of a request, in words, each line to be corrected: the reading, what other parts should do, which
// relations give way.

import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { Answer } from '../llm/session';
import { costOf, isDemo } from '../llm/settings';
import type { Hint } from '../program/operators';
import type { Layer, Shape, Statement } from '../program/types';
import { isDivisible } from '../session/divide';
import { type Understood, whyUndecided } from '../session/request';
import {
  applyRequest,
  askAgain,
  chooseReading,
  correctEdit,
  dismiss,
  divideRequest,
  requestLayer,
  requestText,
} from '../session/requests';
import { document, pointedAt, task } from '../session/session';
import { plural, price, t } from '../texts/texts';
import { dialog } from './actions';
import { Hints } from './HandPanel';
import { Icon } from './Icon';
import { SeedList } from './SeedFields';
import { SidesRead } from './SidesSwitch';
import { givenUpWords, relationWords, statementWords } from './words';

export function ReadingCard({ state }: { state: Understood }) {
  const { inference } = state.answer;
  const { seed } = inference;
  const undecided = whyUndecided(inference, state.plain);
  const layer = requestLayer.value;
  const chosen = seed.readings[state.reading];
  const open = useSignal(undecided !== null);
  const note = layer && effectWords(layer);
  const corrected = correctedWords(state);
  return (
    <section class="reading" aria-label={t`What was understood`}>
      <header>
        <button
          type="button"
          class="reading-title"
          aria-expanded={open.value}
          onClick={() => {
            open.value = !open.value;
          }}
        >
          <Icon name={open.value ? 'down' : 'right'} />
          {layer !== null && chosen ? (
            <span>
              <span class="quiet">{corrected === null ? t`Understood:` : t`Corrected:`}</span>{' '}
              {corrected ?? chosen.words}
            </span>
          ) : (
            <span>
              {undecided ??
                (task.value === null
                  ? t`“${state.request}” was understood, but is not applied`
                  : t`“${state.request}” is understood, and is being worked out`)}
            </span>
          )}
        </button>
        {layer !== null && seed.of > 1 && chosen && <span class="quiet votes">{t`${chosen.votes} of ${seed.of}`}</span>}
        <button type="button" class="button icon-only" aria-label={t`Close what was understood`} onClick={dismiss}>
          <Icon name="close" />
        </button>
      </header>
      <SidesRead state={state} />
      {state.plain !== null && <Plainly state={state} />}
      {note && <p class="quiet note-line">{note}</p>}
      {layer !== null && isDivisible(state) && <Divided count={state.edit?.seed.length ?? 0} />}
      {open.value && <Corrections state={state} />}
    </section>
  );
}

/** What may have been meant, while it is not decided and nothing came of it. */
const plainOffers = ({ plain }: Understood) =>
  plain !== null && !plain.sure && requestLayer.value === null ? plain.readings : [];

/** Says that no language model was asked, and asks one; with what may have been meant, to be clicked, when it is not sure. */
function Plainly({ state }: { state: Understood }) {
  const offers = plainOffers(state);
  const choose = (reading: number) => {
    chooseReading(reading);
    void applyRequest();
  };
  return (
    <>
      {offers.length > 0 && (
        <div class="offers">
          {offers.map(({ words }, i) => (
            <button key={words} type="button" class="try" disabled={task.value !== null} onClick={() => choose(i)}>
              {words}
            </button>
          ))}
        </div>
      )}
      <p class="plainly">
        <span class="quiet grow">{t`Read without a language model`}</span>
        <button
          type="button"
          class="button"
          disabled={requestText.value !== '' && requestText.value !== state.typed}
          onClick={() => {
            if (isDemo.peek()) dialog.value = 'model';
            else void askAgain(state);
          }}
        >
          {t`Ask a language model instead`}
        </button>
      </p>
    </>
  );
}

/** Says that one slider does several things, and gives each its own. */
function Divided({ count }: { count: number }) {
  return (
    <p class="plainly">
      <span class="quiet grow">{plural(count, '{n} change by one slider', '{n} changes by one slider')}</span>
      <button
        type="button"
        class="button"
        disabled={task.value !== null}
        onClick={() => void divideRequest((statement) => statementWords(document.peek(), statement))}
      >
        {t`A slider for each`}
      </button>
    </p>
  );
}

/** The edits in words, when they are no longer those of the reading that was chosen. */
function correctedWords({ edit, answer, reading }: Understood): string | null {
  const words = (statements: readonly Statement[]) =>
    statements.map((statement) => statementWords(document.value, statement)).join('; ');
  const chosen = answer.inference.seed.readings[reading]?.statements;
  if (edit === null || chosen === undefined) return null;
  const now = words(edit.seed);
  // The core has checked the statements against the shape.
  if (now === words(chosen as unknown as readonly Statement[])) return null;
  return now.charAt(0).toLowerCase() + now.slice(1);
}

function Corrections({ state }: { state: Understood }) {
  const { inference } = state.answer;
  const { seed, relations } = inference;
  const isApplied = requestLayer.value !== null;
  const shape = state.model.shape;
  const leave = () => {
    pointedAt.value = null;
  };
  useEffect(() => leave, []); // what is pointed at may go away under the pointer
  return (
    <div class="corrections">
      {seed.readings.length > 0 && plainOffers(state).length === 0 && (
        <fieldset>
          <legend>{seed.readings.length > 1 ? t`Readings` : t`Reading`}</legend>
          {seed.readings.map(({ words, votes }, i) => (
            <label class="check" key={words}>
              <input
                type="radio"
                name="reading"
                checked={state.edit !== null && state.reading === i}
                onChange={() => chooseReading(i)}
              />
              <span class="grow">{words}</span>
              {state.plain === null && <span class="quiet votes">{t`${votes} of ${seed.of}`}</span>}
            </label>
          ))}
        </fieldset>
      )}
      {state.edit !== null && <SeedCorrections shape={shape} seed={state.edit.seed} />}
      {state.edit !== null && <Hints shape={shape} except="" chosen={hintsOf(state)} />}
      {state.edit !== null && relations.length > 0 && (
        <details open={relations.some(({ keep }) => !keep)}>
          <summary>{givenUpWords(shape, relations, state.edit.disabled)}</summary>
          {relations.map(({ relation, words, votes, of }) => {
            const known = shape.relations.find(({ id }) => id === relation);
            const point = () => {
              pointedAt.value = { parts: known?.parts ?? [], relations: [relation] };
            };
            const disabled = state.edit?.disabled ?? [];
            return (
              <label class="check" key={relation} onPointerEnter={point} onPointerLeave={leave}>
                <input
                  type="checkbox"
                  checked={!disabled.includes(relation)}
                  onFocus={point}
                  onBlur={leave}
                  onChange={(event) => {
                    const others = disabled.filter((id) => id !== relation);
                    correctEdit({ disabled: event.currentTarget.checked ? others : [...others, relation] });
                  }}
                />
                <span class="grow">{t`Keep: ${known ? relationWords(document.value, known) : words}`}</span>
                {state.plain === null && <span class="quiet votes">{t`${votes} of ${of}`}</span>}
              </label>
            );
          })}
        </details>
      )}
      <div class="row">
        {!isApplied && state.edit !== null && (
          <button
            type="button"
            class="button primary"
            disabled={task.value !== null}
            onClick={() => void applyRequest()}
          >
            {t`Apply this`}
          </button>
        )}
        {!isDemo.value && state.plain === null && (
          <button
            type="button"
            class="button"
            title={t`Asks the language model once more`}
            disabled={requestText.value !== '' && requestText.value !== state.typed}
            onClick={() => void askAgain(state)}
          >
            {t`Ask again`}
          </button>
        )}
        {state.plain === null && <span class="quiet grow votes">{spentWords(state.answer)}</span>}
      </div>
      <Failures answer={state.answer} />
    </div>
  );
}

/** The edits themselves, field by field. */
function SeedCorrections({ shape, seed }: { shape: Shape; seed: readonly Statement[] }) {
  return (
    <details class="seeds">
      <summary>{plural(seed.length, 'Correct the edit', 'Correct the {n} edits')}</summary>
      <SeedList shape={shape} seed={seed} onChange={(next) => correctEdit({ seed: next })} />
    </details>
  );
}

/** The hints of the edit, read and written like a signal. */
const hintsOf = (state: Understood) => ({
  get value(): ReadonlyMap<string, Hint> {
    return new Map(Object.entries(state.edit?.hints ?? {}));
  },
  set value(hints: ReadonlyMap<string, Hint>) {
    correctEdit({ hints: Object.fromEntries(hints) });
  },
});

/** What has to be said of a layer that does less than one may have hoped. */
function effectWords({ parameter, statements }: Layer): string | null {
  if (parameter.max - parameter.min < 1e-6) return t`Nothing can move: at any other position a part would collapse.`;
  const followers = statements.filter(({ op, why }) => op !== 'keep_fixed' && why?.kind !== 'seed');
  return followers.length === 0 ? t`No other part has to follow.` : null;
}

const answersWords = (n: number) => plural(n, '{n} answer', '{n} answers');

function spentWords(answer: Answer): string {
  const { calls, kept, tokens } = answer;
  if (isDemo.value) return t`recorded answers`;
  const cost = costOf(tokens);
  return [
    calls > 0 && `${answersWords(calls)}, ${plural(tokens.input + tokens.output, '{n} token', '{n} tokens')}`,
    calls > 0 && cost !== null && t`cost ${price(cost)}`,
    kept > 0 && t`${kept} kept from before`,
  ]
    .filter(Boolean)
    .join(' · ');
}

/** What of the asking failed without stopping it. */
function Failures({ answer }: { answer: Answer }) {
  const { failures, inference } = answer;
  const refused = inference.refused;
  return (
    <>
      {failures[0] && (
        <p class="quiet">
          {plural(
            failures.length,
            '{n} answer did not come. {0}',
            '{n} answers did not come. {0}',
            failures[0].message,
          )}
        </p>
      )}
      {refused[0] && (
        <p class="quiet">
          {plural(
            refused.length,
            '{n} answer could not be used: {0}.',
            '{n} answers could not be used: {0}.',
            refused[0].error.cause,
          )}
        </p>
      )}
    </>
  );
}
