// Where one says what to change: the request with the parts it mentions, what can be tried, how far the answers are, what
// was understood, and what went wrong.

import { effect, type Signal, useSignal } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import type { Estimate, TaskProgress } from '../llm/session';
import { choiceOf, costOf, isDemo, settings } from '../llm/settings';
import { models } from '../session/core';
import { stepWords } from '../session/core_steps';
import { nameOf } from '../session/document';
import {
  cancelRequest,
  dismiss,
  estimateRequest,
  mention,
  mentioned,
  request,
  requestText,
  sendRequest,
  unmention,
} from '../session/requests';
import { document, selection } from '../session/session';
import { suggestions } from '../session/suggestions';
import { price, t } from '../texts/texts';
import { AskFailure } from './AskFailure';
import { dialog } from './actions';
import { Icon } from './Icon';
import { paintNumbered } from './pictures';
import { ReadingCard } from './ReadingCard';
import { useRecorded } from './recorded';
import { SidesLine } from './SidesSwitch';
import { useStandsBelow } from './window_bottom';

const maxLength = 1000;

/** @param picking whether clicks in the view belong to the edit by hand */
export function Composer({ picking }: { picking: boolean }) {
  const field = useRef<HTMLTextAreaElement>(null);
  // On a phone it lies over the end of the sheet, which leaves room for it.
  const stands = useStandsBelow({ property: '--composer-height' });
  const isFocused = useSignal(false);
  const state = request.value;
  const isAsking = state.kind === 'asking';
  useMentions(picking, isFocused);
  if (document.value.model === null) return null;
  const name = isDemo.value ? t`Recorded answers` : choiceOf(settings.value.provider).model;

  const send = () => void sendRequest();
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Enter' && !event.shiftKey && !event.isComposing) send();
    else if (event.key === 'Escape' && isAsking) cancelRequest();
    else if (event.key === 'Escape') field.current?.blur();
    else if (event.key === 'Backspace' && requestText.peek() === '') mentioned.value = mentioned.peek().slice(0, -1);
    else return;
    if (event.key !== 'Backspace') event.preventDefault();
  };
  return (
    <section class="composer panel" aria-label={t`Request in words`} ref={stands}>
      <div class="composer-said">
        {state.kind === 'understood' && state.model === document.value.model && (
          <ReadingCard key={state.answer} state={state} />
        )}
        {state.kind === 'failed' && (
          <AskFailure text={state.text} isSetting={state.isSetting}>
            <button type="button" class="button icon-only" aria-label={t`Dismiss`} onClick={dismiss}>
              <Icon name="close" />
            </button>
          </AskFailure>
        )}
        <div role="status">{isAsking && <Asking tasks={state.tasks} />}</div>
      </div>
      <form
        class="composer-row"
        onSubmit={(event) => {
          event.preventDefault();
          send();
        }}
      >
        <div class="composer-field">
          <Mentions />
          <textarea
            ref={field}
            rows={1}
            maxLength={maxLength}
            value={requestText.value}
            readOnly={isAsking}
            placeholder={t`Say what to change…`}
            aria-label={t`What to change`}
            onInput={(event) => {
              requestText.value = event.currentTarget.value;
              // What was wrong with a request goes with it.
              if (requestText.value === '' && state.kind === 'failed') dismiss();
            }}
            onKeyDown={onKeyDown}
            onFocus={() => {
              isFocused.value = true;
            }}
            onBlur={() => {
              isFocused.value = false;
            }}
          />
        </div>
        <button
          type="button"
          class="button suggest-button"
          aria-label={t`Suggest sliders`}
          title={t`Suggest sliders for this model`}
          disabled={models.value === null}
          onClick={() => void suggestions.start({ task: 'procedural_requests' }, paintNumbered)}
        >
          <Icon name="sparkle" />
          <span>{t`Suggest sliders`}</span>
        </button>
        <button
          type="button"
          class="button icon-only"
          aria-label={t`Language model: ${name}`}
          title={t`Language model: ${name}`}
          aria-haspopup="dialog"
          onClick={() => (dialog.value = 'model')}
        >
          <Icon name="settings" />
        </button>
        <button
          type="submit"
          class="button icon-only primary"
          aria-label={t`Send`}
          title={t`Send (Enter)`}
          disabled={isAsking || requestText.value.trim() === '' || models.value === null}
        >
          <Icon name="send" />
        </button>
      </form>
      {!isAsking && <SidesLine />}
      <Below />
    </section>
  );
}

/** While something is being written, a click on a part mentions it. */
function useMentions(picking: boolean, isFocused: Signal<boolean>): void {
  // From the first moment: an effect that waits for a paint takes a part that was selected before for one of the request.
  useLayoutEffect(() => {
    let last = selection.peek()?.part ?? null;
    return effect(() => {
      const part = selection.value?.part ?? null;
      if (part === last) return;
      last = part;
      const isWriting = isFocused.peek() || requestText.peek() !== '' || mentioned.peek().length > 0;
      if (part !== null && isWriting && !picking && request.peek().kind !== 'asking') mention(part);
    });
  }, [picking, isFocused]);
}

function Mentions() {
  const parts = document.value.model?.shape.parts ?? [];
  const part = selection.value?.part;
  const offered = part !== undefined && !mentioned.value.includes(part) ? part : null;
  const known = mentioned.value.filter((id) => parts.some((other) => other.id === id));
  return (
    <>
      {known.map((id) => (
        <span class="mention" key={id}>
          <span>{nameOf(document.value, id)}</span>
          <button
            type="button"
            aria-label={t`Do not mention ${nameOf(document.value, id)}`}
            onClick={() => unmention(id)}
          >
            <Icon name="close" />
          </button>
        </span>
      ))}
      {offered !== null && (
        <button
          type="button"
          class="mention offered"
          aria-label={t`Mention ${nameOf(document.value, offered)}`}
          title={t`Mention the selected part in the request`}
          onClick={() => mention(offered)}
        >
          + {nameOf(document.value, offered)}
        </button>
      )}
    </>
  );
}

function Asking({ tasks }: { tasks: readonly TaskProgress[] }) {
  const done = tasks.reduce((sum, task) => sum + task.done, 0);
  const of = tasks.reduce((sum, task) => sum + task.of, 0);
  return (
    <div class="asking">
      <span class="spinner" aria-hidden="true" />
      <div class="grow">
        <p>{of > 0 ? t`Reading the request, ${done} of ${of} answers` : t`Reading the request`}</p>
        <p class="quiet">
          {tasks
            .filter((task) => task.of > 0)
            .map((task) => t`${stepWords(task.words)} ${task.done} of ${task.of}`)
            .join(' · ')}
        </p>
      </div>
      <button type="button" class="button" onClick={cancelRequest}>
        {t`Cancel`}
      </button>
    </div>
  );
}

/** What sending will take, where it is paid for; else what can be tried. */
function Below() {
  const recorded = useRecorded();
  const [first] = mentioned.value;
  const isEmpty = requestText.value === '' && first === undefined;
  if (request.value.kind === 'asking') return null;
  if (!isEmpty && !isDemo.value) return <EstimateLine />;
  const made = new Set(document.value.layers.map(({ layer }) => layer.request.toLowerCase()));
  const open = recorded.filter((known) => !made.has(known.request.toLowerCase()));
  if (open.length === 0 || (!isEmpty && request.value.kind !== 'failed')) return null;
  return (
    <div class="tries">
      <span class="quiet">{t`try:`}</span>
      {open.map((known) => (
        <button
          key={`${known.request} ${known.mentioned.join()}`}
          type="button"
          class="try"
          onClick={() => {
            requestText.value = known.request;
            mentioned.value = known.mentioned;
            void sendRequest();
          }}
        >
          {known.request}
        </button>
      ))}
    </div>
  );
}

const estimateDelay = 500; // milliseconds after the last key

function EstimateLine() {
  const found = useSignal<Estimate | null>(null);
  const text = requestText.value;
  const parts = mentioned.value;
  const { votes, provider } = settings.value;
  useEffect(() => {
    let current = true;
    const timer = setTimeout(() => {
      estimateRequest()
        .catch(() => null) // sending says what is wrong
        .then((estimate) => {
          if (current) found.value = estimate;
        });
    }, estimateDelay);
    return () => {
      current = false;
      clearTimeout(timer);
    };
  }, [text, parts, votes, provider, found]);
  if (found.value === null) return null;
  const { calls, inputTokens } = found.value;
  const cost = costOf({ input: inputTokens, output: 0 });
  const thousands = Math.round(inputTokens / 1000);
  return (
    <p class="quiet estimate">
      {cost === null
        ? t`${calls} answers, about ${thousands} thousand tokens to send; what comes back is on top`
        : t`${calls} answers, about ${thousands} thousand tokens to send, ${price(cost)}; what comes back is on top`}
    </p>
  );
}
