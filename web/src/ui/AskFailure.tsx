// Why a language model gave no answer, with the way to the settings where these are at fault.
import type { ComponentChildren } from 'preact';
import type { Failed } from '../session/tasks';
import { t } from '../texts/texts';
import { dialog } from './actions';
import { Icon } from './Icon';

/** @param children further buttons */
export function AskFailure({ text, isSetting, children }: Failed & { readonly children?: ComponentChildren }) {
  return (
    <div class="failed" role="alert">
      <Icon name="warning" />
      <p class="grow">{text}</p>
      {isSetting && (
        <button type="button" class="button outlined" onClick={() => (dialog.value = 'model')}>
          {t`Settings`}
        </button>
      )}
      {children}
    </div>
  );
}
