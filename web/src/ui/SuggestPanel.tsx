// Suggested sliders: asked for with one click, they come in as cards, each with pictures of what it does, to be kept,
// renamed, arranged or dropped.

import { useEffect, useRef } from 'preact/hooks';
import { costOf, isDemo } from '../llm/settings';
import { playOnce } from '../session/play';
import type { Asked } from '../session/proposals';
import { isClean } from '../session/proposals';
import { suggestions } from '../session/suggestions';
import { price, t } from '../texts/texts';
import { AskFailure } from './AskFailure';
import { Icon } from './Icon';
import { drawStrips } from './pictures';
import { SuggestCard } from './SuggestCard';

/** Nothing while nothing is asked for. */
export function SuggestPanel() {
  const section = useRef<HTMLElement>(null);
  useEffect(() => drawStrips(suggestions), []);
  const asked = suggestions.asked.value;
  const stop = asked?.stop;
  useEffect(() => {
    if (stop !== undefined) section.current?.scrollIntoView({ block: 'start' });
  }, [stop]);
  if (asked === null) return null;
  const open = suggestions.open.value;
  const clean = open.filter(isClean);
  return (
    <section class="suggested" aria-label={t`Suggested sliders`} ref={section}>
      <header class="row">
        <h3 class="grow">{t`Suggested sliders`}</h3>
        {clean.length > 0 && (
          <button
            type="button"
            class="button primary"
            disabled={asked.isRunning}
            onClick={() => {
              const [first] = suggestions.keepAll();
              if (first !== undefined) playOnce(first);
            }}
          >
            {t`Keep all ${clean.length}`}
          </button>
        )}
        <button
          type="button"
          class="button icon-only"
          aria-label={t`Drop all suggestions`}
          title={t`Drop all`}
          onClick={suggestions.close}
        >
          <Icon name="close" />
        </button>
      </header>
      <Progress asked={asked} />
      {asked.failure && <AskFailure {...asked.failure} />}
      <ul class="cards">
        {open.map((proposal, i) => (
          <SuggestCard
            key={proposal.key}
            model={asked.model}
            proposal={proposal}
            first={i === 0}
            last={i === open.length - 1}
            isRunning={asked.isRunning}
          />
        ))}
      </ul>
      {asked.dropped.length > 0 && (
        <details>
          <summary>{t`Left out of the answer: ${asked.dropped.length}`}</summary>
          <ul>
            {asked.dropped.map(({ request, reason }) => (
              <li key={`${request} ${reason}`}>
                “{request}” <span class="quiet">{reason}</span>
              </li>
            ))}
          </ul>
        </details>
      )}
    </section>
  );
}

/** One line, and a way to stop; then what it took. */
function Progress({ asked }: { asked: Asked }) {
  const { proposals, isAsking, isRunning } = asked;
  const read = proposals.filter(({ state }) => state.kind !== 'reading').length;
  return (
    <div class="row progress" role="status">
      {isRunning && <span class="spinner" aria-hidden="true" />}
      <p class="grow quiet">
        {isAsking
          ? t`Asking what could vary`
          : isRunning
            ? t`Reading the suggestions, ${read} of ${proposals.length}`
            : endWords(asked)}
      </p>
      {isRunning && (
        <button type="button" class="button outlined" onClick={suggestions.stop}>
          {t`Cancel`}
        </button>
      )}
    </div>
  );
}

function endWords({ proposals, spent }: Asked): string {
  if (proposals.length === 0) return '';
  const clean = proposals.filter(isClean).length;
  const sliders = t`${clean} of ${proposals.length} are clean`;
  if (isDemo.value) return `${sliders} · ${t`recorded answers`}`;
  const { input, output } = spent.tokens;
  const cost = costOf(spent.tokens);
  return [
    sliders,
    spent.calls > 0 && t`${spent.calls} answers, ${input + output} tokens`,
    spent.calls > 0 && cost !== null && t`cost ${price(cost)}`,
  ]
    .filter(Boolean)
    .join(' · ');
}
