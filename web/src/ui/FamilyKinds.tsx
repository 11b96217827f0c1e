// Kinds that a language model suggests, as cards: each comes in with a picture when its numbers are there, and is kept as a
// variation or dropped.

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { costOf, isDemo } from '../llm/settings';
import type { FamilyState } from '../session/family_found';
import { kinds } from '../session/kind_suggestions';
import type { AskedKinds, KindCard } from '../session/kinds';
import { task } from '../session/session';
import { price, t } from '../texts/texts';
import { AskFailure } from './AskFailure';
import { Icon } from './Icon';
import { drawKinds, kindPictures } from './kind_pictures';
import { listWords } from './words';

/** The button that asks, and one's own word for a kind. */
export function SuggestKinds() {
  const name = useSignal('');
  const typed = name.value.trim();
  const isRunning = kinds.asked.value?.isRunning ?? false;
  return (
    <form
      class="row keep"
      onSubmit={(event) => {
        event.preventDefault();
        if (typed === '') return;
        void kinds.draw(typed);
        name.value = '';
      }}
    >
      <button
        type="button"
        class="button outlined"
        disabled={isRunning || task.value !== null}
        title={t`Asks a language model which kinds of this there are, and draws the most common ones`}
        onClick={() => void kinds.start()}
      >
        <Icon name="sparkle" /> {t`Suggest kinds`}
      </button>
      {!isDemo.value && (
        <>
          <input
            class="grow"
            type="text"
            maxLength={60}
            placeholder={t`Or one that you name`}
            aria-label={t`A kind to draw`}
            value={name.value}
            onInput={(event) => (name.value = event.currentTarget.value)}
          />
          <button type="submit" class="button" disabled={typed === '' || isRunning}>
            {t`Draw`}
          </button>
        </>
      )}
    </form>
  );
}

export function FamilyKinds({ family }: { family: FamilyState }) {
  const section = useRef<HTMLElement>(null);
  const asked = kinds.asked.value;
  useEffect(() => drawKinds(kinds), []);
  const stop = asked?.stop;
  useEffect(() => {
    if (stop !== undefined) section.current?.scrollIntoView({ block: 'start' });
  }, [stop]);
  if (asked === null) return null;
  const drawn = asked.cards.filter(({ state }) => state.kind === 'drawn');
  const known = new Set(family.found.family.variations.map(({ name }) => name));
  return (
    <section class="suggested" aria-label={t`Suggested kinds`} ref={section}>
      <header class="row">
        <h3 class="grow">{t`Suggested kinds`}</h3>
        {drawn.length > 1 && (
          <button
            type="button"
            class="button primary"
            disabled={asked.isRunning || task.value !== null}
            onClick={() => void kinds.keep()}
          >
            {t`Keep all ${drawn.length}`}
          </button>
        )}
        <button
          type="button"
          class="button icon-only"
          aria-label={t`Drop all suggested kinds`}
          title={t`Drop all`}
          onClick={kinds.close}
        >
          <Icon name="close" />
        </button>
      </header>
      <Progress asked={asked} />
      {asked.failure && <AskFailure {...asked.failure} />}
      <ul class="cards kinds">
        {asked.cards.map((card) =>
          card.state.kind === 'named' ? null : (
            <Card key={card.name} asked={asked} card={card} isKnown={known.has(card.name)} />
          ),
        )}
      </ul>
      <Others asked={asked} />
    </section>
  );
}

/** One line, and a way to stop; then what it took. */
function Progress({ asked }: { asked: AskedKinds }) {
  const { cards, isAsking, isRunning } = asked;
  const wanted = cards.filter(({ state }) => state.kind !== 'named' && state.kind !== 'stopped');
  const done = wanted.filter(({ state }) => state.kind !== 'asking').length;
  return (
    <div class="row progress" role="status">
      {isRunning && <span class="spinner" aria-hidden="true" />}
      <p class="grow quiet">
        {isAsking
          ? t`Asking which kinds there are`
          : isRunning
            ? t`Asking what they measure, ${done} of ${wanted.length}`
            : endWords(asked)}
      </p>
      {isRunning && (
        <button type="button" class="button outlined" onClick={kinds.stop}>
          {t`Cancel`}
        </button>
      )}
    </div>
  );
}

function endWords({ cards, spent }: AskedKinds): string {
  const drawn = cards.filter(({ state }) => state.kind === 'drawn').length;
  if (drawn === 0) return '';
  if (isDemo.value) return `${t`${drawn} drawn`} · ${t`recorded answers`}`;
  const { input, output } = spent.tokens;
  const cost = costOf(spent.tokens);
  return [
    t`${drawn} drawn`,
    spent.calls > 0 && t`${spent.calls} answers, ${input + output} tokens`,
    spent.calls > 0 && cost !== null && t`cost ${price(cost)}`,
  ]
    .filter(Boolean)
    .join(' · ');
}

/** Kinds that fewer answers name, which are drawn when they are asked for. */
function Others({ asked }: { asked: AskedKinds }) {
  const others = asked.cards.filter(({ state }) => state.kind === 'named');
  if (others.length === 0 || asked.isRunning) return null;
  return (
    <details>
      <summary>{t`Also named: ${others.length}`}</summary>
      {isDemo.value && <p class="quiet">{t`Their numbers are not recorded: to draw them needs a key.`}</p>}
      <ul class="other-kinds">
        {others.map(({ name, words, votes }) => (
          <li key={name} class="row">
            <p class="grow">
              {name} <span class="quiet">{`${words} · ${t`${votes} of ${asked.answers}`}`}</span>
            </p>
            {!isDemo.value && (
              <button
                type="button"
                class="button outlined"
                aria-label={t`Draw ${name}`}
                onClick={() => void kinds.draw(name)}
              >
                {t`Draw`}
              </button>
            )}
          </li>
        ))}
      </ul>
    </details>
  );
}

interface CardProps {
  readonly asked: AskedKinds;
  readonly card: KindCard;
  /** Whether there is a variation of this name already. */
  readonly isKnown: boolean;
}

function Card({ asked, card, isKnown }: CardProps) {
  const { name, words, votes, state } = card;
  const url = state.kind === 'drawn' ? kindPictures.value.get(state.picture) : undefined;
  const named = votes === 0 ? '' : t`${votes} of ${asked.answers} answers name it`;
  return (
    <li class="card proposal kind" aria-label={name}>
      <span class="thumbnail">{url !== undefined && <img src={url} alt="" />}</span>
      <div class="about">
        <h4>{name}</h4>
        {words !== '' && <p class="quiet">{words}</p>}
        {state.kind === 'asking' && (
          <p class="quiet">{state.of > 1 ? t`${state.done} of ${state.of} answers` : t`Being asked…`}</p>
        )}
        {state.kind === 'stopped' && <p class="quiet">{t`Not drawn: it was stopped.`}</p>}
        {state.kind === 'refused' && (
          <p class="broken unclean">
            <Icon name="warning" />
            <span>{state.text}</span>
          </p>
        )}
        {state.kind === 'drawn' && <p class="quiet">{[drawnWords(asked, state), named].filter(Boolean).join(' · ')}</p>}
        {state.kind !== 'asking' && (
          <div class="row wrap">
            {state.kind === 'drawn' ? (
              <button
                type="button"
                class="button outlined"
                disabled={task.value !== null}
                title={isKnown ? t`The variation of this name gives way` : t`Makes it one of the variations`}
                onClick={() => void kinds.keep([name])}
              >
                <Icon name="check" /> {isKnown ? t`Replace` : t`Keep`}
              </button>
            ) : (
              <button
                type="button"
                class="button outlined"
                disabled={asked.isRunning}
                onClick={() => void kinds.draw(name)}
              >
                {t`Try again`}
              </button>
            )}
            <button type="button" class="button" aria-label={t`Drop ${name}`} onClick={() => kinds.drop(name)}>
              {t`Drop`}
            </button>
          </div>
        )}
      </div>
    </li>
  );
}

/** "without back and arm × 2", and what of the answers could not be used. */
function drawnWords(
  { model }: AskedKinds,
  { variation, refused, votes }: Extract<KindCard['state'], { kind: 'drawn' }>,
) {
  const parts = model.files.cad?.parts ?? [];
  const absent = (variation as { readonly absent?: readonly string[] }).absent ?? [];
  const counts = new Map<string, number>();
  for (const id of absent) {
    const stem = parts.find((part) => part.id === id)?.stem ?? id;
    counts.set(stem, (counts.get(stem) ?? 0) + 1);
  }
  const stems = [...counts].map(([stem, count]) => (count === 1 ? stem : `${stem} × ${count}`));
  const lacks = stems.length === 0 ? '' : t`without ${listWords(stems)}`;
  const left = refused === 0 ? '' : t`${refused} of ${refused + votes} answers could not be used`;
  return [lacks, left].filter(Boolean).join(' · ');
}
