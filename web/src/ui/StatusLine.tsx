// One line for what is being done, with a way to stop it, and for what has to be said.

import { signal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { autosave } from '../session/autosave';
import { core, models } from '../session/core';
import { awaited, awaitedAddress, fetchAwaited, fetchOffered, offered } from '../session/open';
import { document, notice, task } from '../session/session';
import { m, t } from '../texts/texts';
import { saveSession } from './actions';
import { isInForeignFrame } from './frame';
import { Icon } from './Icon';
import { rich } from './rich';
import { update, updateReady } from './update';

export function StatusLine() {
  const state = core.value;
  const text = notice.value?.text ?? '';
  return (
    <div class="status-line">
      {/* Always there, so that screen readers hear changes. */}
      <div role="status">
        {task.value && (
          <p class="panel note">
            <span class="spinner" aria-hidden="true" />
            {task.value.text}
            <button type="button" class="button" onClick={() => task.value?.cancel()}>
              {t`Cancel`}
            </button>
          </p>
        )}
        {state.kind === 'failed' && <p class="panel note error">{state.text}</p>}
        {updateReady.value && !task.value && (
          <p class="panel note">
            {t`A new version is ready.`}
            <button type="button" class="button" onClick={() => void update()}>
              {t`Reload`}
            </button>
            <DismissButton onClick={() => (updateReady.value = false)} />
          </p>
        )}
        {!task.value && text && notice.value?.kind === 'info' && <Note text={text} kind="info" />}
        {!task.value && <Awaited />}
      </div>
      <div role="alert">
        <Unkept />
        {notice.value?.kind === 'error' && text && <Note text={text} kind="error" />}
      </div>
    </div>
  );
}

/** A page around this one could lure a click here: it gets nothing but this site's own files. */
const mayFetch = (address: string) =>
  (new URL(address).origin === location.origin || !isInForeignFrame()) && models.value !== null;

/** Work that waits for its model, or a model that a link names. What they ask for is shown first: it is a stranger's. */
function Awaited() {
  const work = awaited.value;
  const address = work === null ? offered.value : awaitedAddress.value;
  if (work === null && address === null) return null;
  const made = work === null ? t`This link names a model` : t`This work was made on “${work.saved.model.name}”`;
  const fetchIt = () => {
    const core = models.value;
    if (core !== null) void (work === null ? fetchOffered(core) : fetchAwaited(core));
  };
  return (
    <p class="panel note">
      {address !== null && mayFetch(address) ? (
        <>
          <span>
            {rich(t`${made}, to be fetched from <code>${address}</code>`, {
              code: (text) => <code class="address">{text}</code>,
            })}
          </span>
          <button type="button" class="button" onClick={fetchIt}>
            {t`Fetch it`}
          </button>
        </>
      ) : (
        <span>{t`${made}. Drop that file here to see it.`}</span>
      )}
      <button
        type="button"
        class="button"
        onClick={() => {
          awaited.value = offered.value = null;
        }}
      >
        {t`Forget it`}
      </button>
    </p>
  );
}

const unkeptWords = {
  full: m`This browser has no room left for your work: a reload would lose it.`,
  refused: m`This browser does not keep your work: a reload would lose it.`,
} as const;

/** Said once; again when saving has worked in between. */
const isDismissed = signal(false);
autosave.unkept.subscribe((why) => {
  if (why === null) isDismissed.value = false;
});

function Unkept() {
  const why = autosave.unkept.value;
  if (why === null || isDismissed.value || document.value.model === null) return null;
  return (
    <ErrorNote onDismiss={() => (isDismissed.value = true)}>
      <span>{t(unkeptWords[why])}</span>
      <button type="button" class="button" onClick={saveSession}>
        {t`Save it as a file`}
      </button>
    </ErrorNote>
  );
}

function ErrorNote({ children, onDismiss }: { children: ComponentChildren; onDismiss: () => void }) {
  return (
    <p class="panel note error">
      <Icon name="warning" />
      {children}
      <DismissButton onClick={onDismiss} />
    </p>
  );
}

function Note({ text, kind }: { text: string; kind: 'info' | 'error' }) {
  const dismiss = () => {
    notice.value = null;
  };
  if (kind === 'error') {
    return (
      <ErrorNote onDismiss={dismiss}>
        <span>{text}</span>
      </ErrorNote>
    );
  }
  return (
    <p class="panel note">
      <span>{text}</span>
      <DismissButton onClick={dismiss} />
    </p>
  );
}

function DismissButton({ onClick }: { onClick: () => void }) {
  return (
    <button type="button" class="button icon-only" aria-label={t`Dismiss`} onClick={onClick}>
      <Icon name="close" />
    </button>
  );
}
