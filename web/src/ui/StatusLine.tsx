// One line for what is being done, with a way to stop it, and for what has to be said.
import { core } from '../session/core';
import { awaited } from '../session/open';
import { notice, task } from '../session/session';
import { Icon } from './Icon';
import { update, updateReady } from './update';

export function StatusLine() {
  const state = core.value;
  const missing = awaited.value;
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
              Cancel
            </button>
          </p>
        )}
        {state.kind === 'failed' && <p class="panel note error">{state.text}</p>}
        {updateReady.value && !task.value && (
          <p class="panel note">
            A new version is ready.
            <button type="button" class="button" onClick={() => void update()}>
              Reload
            </button>
            <DismissButton onClick={() => (updateReady.value = false)} />
          </p>
        )}
        {!task.value && text && notice.value?.kind === 'info' && <Note text={text} kind="info" />}
        {missing && !task.value && (
          <p class="panel note">
            This work was made on “{missing.model.name}”. Drop that file here to see it.
            <button
              type="button"
              class="button"
              onClick={() => {
                awaited.value = null;
              }}
            >
              Forget it
            </button>
          </p>
        )}
      </div>
      <div role="alert">{notice.value?.kind === 'error' && text && <Note text={text} kind="error" />}</div>
    </div>
  );
}

function Note({ text, kind }: { text: string; kind: 'info' | 'error' }) {
  return (
    <p class={`panel note ${kind}`}>
      {kind === 'error' && <Icon name="warning" />}
      <span>{text}</span>
      <DismissButton onClick={() => (notice.value = null)} />
    </p>
  );
}

function DismissButton({ onClick }: { onClick: () => void }) {
  return (
    <button type="button" class="button icon-only" aria-label="Dismiss" onClick={onClick}>
      <Icon name="close" />
    </button>
  );
}
