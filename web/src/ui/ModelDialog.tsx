// Which language model is asked: provider, address, model, key, votes, prices. Changes hold at once.
import { useSignal } from '@preact/signals';
import { useEffect, useId } from 'preact/hooks';
import { clearReplies } from '../llm/cache';
import { defaultModel, lookedUp } from '../llm/default_models';
import { complete, listModels } from '../llm/http';
import { forgetKey, type Keeping, keepKey, keyFor } from '../llm/keys';
import { isAllowed, isLocal, type Provider, providerOf, providers } from '../llm/providers';
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
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { SoFar, WhatIsSent } from './ModelCost';

const keepings: readonly { id: Keeping; label: string }[] = [
  { id: 'memory', label: 'Only until this page closes' },
  { id: 'session', label: 'Until this tab closes, reloads included' },
  { id: 'remember', label: 'Remember it in this browser' },
];

export function ModelDialog() {
  const provider = providerOf(settings.value.provider);
  return (
    <Dialog
      title="Language model"
      class="model-dialog"
      onClose={() => {
        dialog.value = null;
      }}
    >
      <label class="field">
        <span>Provider</span>
        <select
          value={settings.value.provider}
          onChange={(event) => {
            const id = event.currentTarget.value;
            if (id === recorded) settings.value = { ...settings.peek(), provider: id };
            else choose(id, {});
          }}
        >
          <option value={recorded}>Recorded answers, without a key</option>
          {providers.map(({ id, title }) => (
            <option key={id} value={id}>
              {title}
            </option>
          ))}
        </select>
      </label>
      {isDemo.value || provider === undefined ? (
        <p class="quiet">
          The suggestions of the gallery’s models work with answers that language models gave before. To ask anything of
          any model, choose a provider. Requests then go from this browser straight to that provider, and nowhere else.
        </p>
      ) : (
        <ProviderFields key={provider.id} provider={provider} />
      )}
      <button type="button" class="button primary" onClick={() => (dialog.value = null)}>
        Done
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
            <li key={text}>{text}</li>
          ))}
        </ul>
      )}
      <label class="field">
        <span>Base URL</span>
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
          This page may only talk to the listed providers and to http://localhost or http://127.0.0.1 with any port. A
          gateway elsewhere needs its host added to the page’s security policy.
        </p>
      )}
      {provider.keysAt !== null && <KeyFields provider={provider} base={choice.base} />}
      <label class="field">
        <span>Model</span>
        <input
          type="text"
          value={choice.model}
          list={modelList}
          spellcheck={false}
          autocomplete="off"
          placeholder={defaultModel(provider.id) || 'name, as the provider writes it'}
          aria-describedby={modelHint}
          onChange={(event) => change({ model: event.currentTarget.value.trim() })}
        />
      </label>
      <p class="quiet" id={modelHint}>
        {choice.model === ''
          ? `Left empty: ${defaultModel(provider.id)}, a sensible one when it was looked up (${day(lookedUp)}). Type any other, or list them.`
          : `Emptied, it is ${defaultModel(provider.id)} again.`}
      </p>
      <datalist id={modelList}>
        {known.value.map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      <Checks provider={provider} onModels={(names) => (known.value = names)} />
      <label class="field">
        <span>Answers to each question</span>
        <input
          type="number"
          min={1}
          max={maxVotes}
          value={settings.value.votes ?? ''}
          placeholder={local ? '1' : `${measuredVotes.request} to ${measuredVotes.kinds}`}
          onChange={(event) => {
            const typed = event.currentTarget.valueAsNumber;
            const votes = Number.isNaN(typed) ? null : Math.round(Math.min(maxVotes, Math.max(1, typed)));
            settings.value = { ...settings.peek(), votes };
            event.currentTarget.value = String(votes ?? '');
          }}
        />
      </label>
      <p class="quiet">
        More than one are put to the vote, and cost as much more. Left empty:{' '}
        {local
          ? 'one, as this machine is slow'
          : `${measuredVotes.request} for a request, ${measuredVotes.names} for names of parts, ${measuredVotes.kinds} for kinds of a thing, as they were measured`}
        .
      </p>
      <SoFar />
      <WhatIsSent host={URL.canParse(choice.base) ? new URL(choice.base).host : provider.title} sees={provider.sees} />
      <details>
        <summary>Prices and kept answers</summary>
        <p class="quiet">
          With the provider’s prices for a million tokens, in any currency, the cost of a request is shown before it is
          sent.
        </p>
        {(['inputPrice', 'outputPrice'] as const).map((field) => (
          <label class="field" key={field}>
            <span>{field === 'inputPrice' ? 'Price in' : 'Price out'}</span>
            <input
              type="number"
              min={0}
              step="any"
              value={choice[field] ?? ''}
              placeholder="not known"
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
  new Date(`${date}T12:00`).toLocaleDateString('en', { day: 'numeric', month: 'long', year: 'numeric' });

function KeyFields({ provider, base }: { provider: Provider; base: string }) {
  const { key, keeping } = keyFor(base);
  const wanted = useSignal<Keeping>(keeping);
  return (
    <>
      <label class="field">
        <span>Key</span>
        <input
          type="password"
          value={key}
          autocomplete="off"
          spellcheck={false}
          placeholder="paste it here"
          onChange={(event) => keepKey(base, event.currentTarget.value, wanted.value)}
        />
      </label>
      <fieldset>
        <legend>Keep the key</legend>
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
            <span>{label}</span>
          </label>
        ))}
      </fieldset>
      <div class="row">
        <p class="quiet grow">
          It goes to {URL.canParse(base) ? new URL(base).host : 'the provider'} only.{' '}
          <a href={provider.keysAt ?? ''} target="_blank" rel="noreferrer">
            Make a key
          </a>
          {wanted.value === 'remember' && ' Whoever uses this browser can read a remembered key.'}
        </p>
        <button type="button" class="button" disabled={key === ''} onClick={() => forgetKey(base)}>
          Forget the key
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
    run('Asking…', async (signal) => {
      const begin = performance.now();
      const call = { prompt: 'Reply with the one word: ready', schema: null };
      const { tokens } = await complete(currentTarget(), call, { signal });
      const seconds = ((performance.now() - begin) / 1000).toFixed(1);
      const cost = tokens === null ? '' : `, for ${tokens.input + tokens.output} tokens`;
      return `It answered in ${seconds} s${cost}.`;
    });
  const list = () =>
    run('Listing…', async (signal) => {
      const { base, model } = choiceOf(provider.id);
      const { key } = keyFor(base);
      const names = await listModels({ provider, base: base.replace(/\/+$/, ''), model, key }, { signal });
      onModels(names);
      return names.length === 0 ? 'None are listed.' : `${names.length} models: choose one in the field above.`;
    });
  return (
    <div class="checks">
      <button type="button" class="button" onClick={test}>
        {provider.keysAt === null ? 'Test the connection' : 'Test this key'}
      </button>
      <button type="button" class="button" onClick={list}>
        List models
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
      <span class="quiet grow">Answers are kept in this browser, so that none is paid for twice.</span>
      <button
        type="button"
        class="button"
        onClick={async () => {
          await clearReplies();
          done.value = true;
        }}
      >
        {done.value ? 'Forgotten' : 'Forget them'}
      </button>
    </p>
  );
}
