// Which language model is asked: provider, address, model, key, votes, prices. Changes hold at once.

import { useSignal } from '@preact/signals';
import { useEffect, useId } from 'preact/hooks';
import { clearReplies } from '../llm/cache';
import { defaultModel, lookedUp } from '../llm/default_models';
import { complete, listModels } from '../llm/http';
import { forgetKey, type Keeping, keepKey, keyFor } from '../llm/keys';
import { isAllowed, isLocal, type Provider, providerOf, providers, titleOfProvider } from '../llm/providers';
import {
  choiceOf,
  choose,
  currentTarget,
  enteredOf,
  isDemo,
  maxVotes,
  measuredVotes,
  recorded,
  settings,
} from '../llm/settings';
import { sentence } from '../session/tasks';
import { type Language, language, languages, m, number, plural, type Sentence, t } from '../texts/texts';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { changeLanguage } from './language';
import { SoFar, WhatIsSent } from './ModelCost';

const keepings: readonly { id: Keeping; label: Sentence }[] = [
  { id: 'memory', label: m`Only until this page closes` },
  { id: 'session', label: m`Until this tab closes, reloads included` },
  { id: 'remember', label: m`Remember it in this browser` },
];

export function ModelDialog() {
  const provider = providerOf(settings.value.provider);
  return (
    <Dialog
      title={t`Language model`}
      class="model-dialog"
      onClose={() => {
        dialog.value = null;
      }}
    >
      <label class="field">
        <span>{t`Provider`}</span>
        <select
          value={settings.value.provider}
          onChange={(event) => {
            const id = event.currentTarget.value;
            if (id === recorded) settings.value = { ...settings.peek(), provider: id };
            else choose(id, {});
          }}
        >
          <option value={recorded}>{t`Recorded answers, without a key`}</option>
          {providers.map((one) => (
            <option key={one.id} value={one.id}>
              {titleOfProvider(one)}
            </option>
          ))}
        </select>
      </label>
      {isDemo.value || provider === undefined ? (
        <p class="quiet">
          {t`The suggestions of the gallery’s models work with answers that language models gave before. To ask anything of any model, choose a provider. Requests then go from this browser straight to that provider, and nowhere else.`}
        </p>
      ) : (
        <ProviderFields key={provider.id} provider={provider} />
      )}
      <LanguageField />
      <button type="button" class="button primary" onClick={() => (dialog.value = null)}>
        {t`Done`}
      </button>
    </Dialog>
  );
}

function ProviderFields({ provider }: { provider: Provider }) {
  const choice = enteredOf(provider.id);
  const known = useSignal<readonly string[]>([]);
  const modelList = useId();
  const hint = useId();
  const modelHint = useId();
  const change = (next: Parameters<typeof choose>[1]) => choose(provider.id, next);
  const allowed = isAllowed(choice.base);
  const local = isLocal(choice.base);
  return (
    <>
      {provider.pitfalls.length > 0 && (
        <ul class="pitfalls">
          {provider.pitfalls.map((text) => (
            <li key={text}>{t(text)}</li>
          ))}
        </ul>
      )}
      <label class="field">
        <span>{t`Base URL`}</span>
        <input
          type="url"
          value={choice.base}
          spellcheck={false}
          aria-invalid={!allowed}
          aria-describedby={allowed ? undefined : hint}
          onChange={(event) => change({ base: event.currentTarget.value.trim() || provider.base })}
        />
      </label>
      {!allowed && (
        <p class="broken" id={hint}>
          {t`This page may only talk to the listed providers and to http://localhost or http://127.0.0.1 with any port. A gateway elsewhere needs its host added to the page’s security policy.`}
        </p>
      )}
      {provider.keysAt !== null && <KeyFields provider={provider} base={choice.base} />}
      <label class="field">
        <span>{t`Model`}</span>
        <input
          type="text"
          value={choice.model}
          list={modelList}
          spellcheck={false}
          autocomplete="off"
          placeholder={defaultModel(provider.id) || t`name, as the provider writes it`}
          aria-describedby={modelHint}
          onChange={(event) => change({ model: event.currentTarget.value.trim() })}
        />
      </label>
      <p class="quiet" id={modelHint}>
        {choice.model === ''
          ? t`Left empty: ${defaultModel(provider.id)}, a sensible one when it was looked up (${day(lookedUp)}). Type any other, or list them.`
          : t`Emptied, it is ${defaultModel(provider.id)} again.`}
      </p>
      <datalist id={modelList}>
        {known.value.map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      <Checks provider={provider} onModels={(names) => (known.value = names)} />
      <label class="field">
        <span>{t`Answers to each question`}</span>
        <input
          type="number"
          min={1}
          max={maxVotes}
          value={settings.value.votes ?? ''}
          placeholder={local ? '1' : t`${measuredVotes.request} to ${measuredVotes.kinds}`}
          onChange={(event) => {
            const typed = event.currentTarget.valueAsNumber;
            const votes = Number.isNaN(typed) ? null : Math.round(Math.min(maxVotes, Math.max(1, typed)));
            settings.value = { ...settings.peek(), votes };
            event.currentTarget.value = String(votes ?? '');
          }}
        />
      </label>
      <p class="quiet">
        {local
          ? t`More than one are put to the vote, and cost as much more. Left empty: one, as this machine is slow.`
          : t`More than one are put to the vote, and cost as much more. Left empty: ${measuredVotes.request} for a request, ${measuredVotes.names} for names of parts, ${measuredVotes.kinds} for kinds of a thing, as they were measured.`}
      </p>
      <SoFar />
      <WhatIsSent
        host={URL.canParse(choice.base) ? new URL(choice.base).host : titleOfProvider(provider)}
        sees={provider.sees}
      />
      <details>
        <summary>{t`Prices and kept answers`}</summary>
        <p class="quiet">
          {t`With the provider’s prices for a million tokens, in any currency, the cost of a request is shown before it is sent.`}
        </p>
        {(['inputPrice', 'outputPrice'] as const).map((field) => (
          <label class="field" key={field}>
            <span>{field === 'inputPrice' ? t`Price in` : t`Price out`}</span>
            <input
              type="number"
              min={0}
              step="any"
              value={choice[field] ?? ''}
              placeholder={t`not known`}
              onChange={(event) => {
                const price = event.currentTarget.valueAsNumber;
                change({ [field]: Number.isNaN(price) ? null : Math.max(0, price) });
              }}
            />
          </label>
        ))}
        <ForgetReplies />
      </details>
    </>
  );
}

const day = (date: string): string =>
  new Date(`${date}T12:00`).toLocaleDateString(language.value, { day: 'numeric', month: 'long', year: 'numeric' });

function KeyFields({ provider, base }: { provider: Provider; base: string }) {
  const { key, keeping } = keyFor(base);
  const wanted = useSignal<Keeping>(keeping);
  return (
    <>
      <label class="field">
        <span>{t`Key`}</span>
        <input
          type="password"
          value={key}
          autocomplete="off"
          spellcheck={false}
          placeholder={t`paste it here`}
          onChange={(event) => keepKey(base, event.currentTarget.value, wanted.value)}
        />
      </label>
      <fieldset>
        <legend>{t`Keep the key`}</legend>
        {keepings.map(({ id, label }) => (
          <label class="check" key={id}>
            <input
              type="radio"
              name="keeping"
              checked={wanted.value === id}
              onChange={() => {
                wanted.value = id;
                if (key !== '') keepKey(base, key, id);
              }}
            />
            <span>{t(label)}</span>
          </label>
        ))}
      </fieldset>
      <div class="row">
        <p class="quiet grow">
          {t`It goes to ${URL.canParse(base) ? new URL(base).host : t`the provider`} only.`}{' '}
          <a href={provider.keysAt ?? ''} target="_blank" rel="noreferrer">
            {t`Make a key`}
          </a>
          {wanted.value === 'remember' && ` ${t`Whoever uses this browser can read a remembered key.`}`}
        </p>
        <button type="button" class="button" disabled={key === ''} onClick={() => forgetKey(base)}>
          {t`Forget the key`}
        </button>
      </div>
    </>
  );
}

/** Tries the settings with one short question, and asks which models there are. */
function Checks({ provider, onModels }: { provider: Provider; onModels: (names: readonly string[]) => void }) {
  const result = useSignal<{ kind: 'working' | 'good' | 'bad'; text: string } | null>(null);
  const abort = useSignal(new AbortController());
  useEffect(() => () => abort.value.abort(), [abort]);
  const run = async (text: string, work: (signal: AbortSignal) => Promise<string>) => {
    abort.value.abort();
    abort.value = new AbortController();
    const { signal } = abort.value;
    result.value = { kind: 'working', text };
    try {
      const good = await work(signal);
      if (!signal.aborted) result.value = { kind: 'good', text: good };
    } catch (error) {
      if (!signal.aborted) result.value = { kind: 'bad', text: sentence(error) };
    }
  };
  const test = () =>
    run(t`Asking…`, async (signal) => {
      const begin = performance.now();
      const call = { prompt: 'Reply with the one word: ready', schema: null };
      const { tokens } = await complete(currentTarget(), call, { signal });
      const seconds = number((performance.now() - begin) / 1000, 1, 1);
      if (tokens === null) return t`It answered in ${seconds} s.`;
      return t`It answered in ${seconds} s, for ${tokens.input + tokens.output} tokens.`;
    });
  const list = () =>
    run(t`Listing…`, async (signal) => {
      const { base, model } = choiceOf(provider.id);
      const { key } = keyFor(base);
      const names = await listModels({ provider, base: base.replace(/\/+$/, ''), model, key }, { signal });
      onModels(names);
      return names.length === 0
        ? t`None are listed.`
        : plural(
            names.length,
            '{n} model: choose it in the field above.',
            '{n} models: choose one in the field above.',
          );
    });
  return (
    <div class="checks">
      <button type="button" class="button" onClick={test}>
        {provider.keysAt === null ? t`Test the connection` : t`Test this key`}
      </button>
      <button type="button" class="button" onClick={list}>
        {t`List models`}
      </button>
      <p role="status" class={result.value?.kind === 'bad' ? 'broken' : 'quiet'}>
        {result.value?.text}
      </p>
    </div>
  );
}

function ForgetReplies() {
  const done = useSignal(false);
  return (
    <p class="row">
      <span class="quiet grow">{t`Answers are kept in this browser, so that none is paid for twice.`}</span>
      <button
        type="button"
        class="button"
        onClick={async () => {
          await clearReplies();
          done.value = true;
        }}
      >
        {done.value ? t`Forgotten` : t`Forget them`}
      </button>
    </p>
  );
}

/** Every language by its own name, so that it is found by whoever cannot read the page. */
function LanguageField() {
  return (
    <label class="field">
      <span>{t`Language of this page`}</span>
      <select value={language.value} onChange={(event) => void changeLanguage(event.currentTarget.value as Language)}>
        {Object.entries(languages).map(([id, name]) => (
          <option key={id} value={id} lang={id}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}
