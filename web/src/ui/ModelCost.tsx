// What asking a language model means for whoever pays: what it has cost so far, and what goes to the provider.

import { useSignal } from '@preact/signals';
import { providerOf, titleOfProvider } from '../llm/providers';
import { costOf } from '../llm/settings';
import { type Spending, spent } from '../llm/spent';
import { questionTexts } from '../session/requests';
import { plural, price, t } from '../texts/texts';

/** Tokens in and out in a clause, and what they cost where prices are known. */
function spentText({ provider, answers, uncounted, input, output }: Spending): string {
  const cost = costOf({ input, output }, provider);
  return [
    plural(answers, '{n} answer', '{n} answers'),
    answers > uncounted && plural(input, '{n} token sent, {0} received', '{n} tokens sent, {0} received', output),
    uncounted > 0 &&
      (uncounted === answers
        ? t`the provider does not say how many`
        : t`of ${uncounted} the provider did not say how many`),
    answers > uncounted && cost !== null && t`cost ${price(cost)}`,
  ]
    .filter(Boolean)
    .join(' · ');
}

function nameOfProvider(id: string): string {
  const provider = providerOf(id);
  return provider === undefined ? id : titleOfProvider(provider);
}

/** By provider and model, since the page was opened. */
export function SoFar() {
  return (
    <section class="so-far" aria-label={t`Cost so far`}>
      <h3>{t`Since this page was opened`}</h3>
      {spent.value.length === 0 ? (
        <p class="quiet">{t`Nothing was asked of a provider.`}</p>
      ) : (
        <ul>
          {spent.value.map((one) => (
            <li key={`${one.provider} ${one.model}`}>
              {nameOfProvider(one.provider)}, {one.model}: <span class="quiet">{spentText(one)}</span>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}

/** In words, and on demand to the letter. */
export function WhatIsSent({ host, sees }: { host: string; sees: boolean }) {
  const texts = useSignal<readonly string[] | null>(null);
  const failed = useSignal(false);
  const show = () => {
    failed.value = false;
    questionTexts()
      .then((found) => {
        texts.value = found;
      })
      .catch(() => {
        failed.value = true;
      });
  };
  return (
    <details class="sent" onToggle={(event) => event.currentTarget.open && show()}>
      <summary>{t`What is sent`}</summary>
      <ul class="pitfalls">
        <li>
          {t`To ${host}, with your key: your request, and the model in words: what its parts are called, where they are, how large, and how they are joined, mirrored and repeated.`}
        </li>
        {sees && (
          <li>
            {t`With suggestions, of sliders, of names or of other readings, also one picture of the model with numbers on its parts, where the language model can see.`}
          </li>
        )}
        <li>{t`Never: the file, its geometry and textures, your other work. Nothing goes anywhere else.`}</li>
      </ul>
      {failed.value && <p class="broken">{t`The questions could not be written. Close this and try again.`}</p>}
      {texts.value?.[0] !== undefined && (
        <>
          <p class="quiet">
            {plural(
              texts.value.length,
              'To the letter, for what is typed now: the one question.',
              'To the letter, for what is typed now: the first of {n} questions.',
            )}
          </p>
          <textarea
            class="question"
            readOnly
            rows={10}
            aria-label={t`First question to the letter`}
            value={texts.value[0]}
          />
        </>
      )}
      {texts.value?.length === 0 && (
        <p class="quiet">{t`Type a request for an open model, and the question to the letter stands here.`}</p>
      )}
    </details>
  );
}
