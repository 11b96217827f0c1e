// Why a language model gave no answer, with the way to the settings where these are at fault.
import { t } from '../texts/texts';
import { dialog } from './actions';
import { Icon } from './Icon';

export function AskFailure({ text, isSetting }: { readonly text: string; readonly isSetting: boolean }) {
  return (
    <div class="failed" role="alert">
      <Icon name="warning" />
      <p class="grow">{text}</p>
      {isSetting && (
        <button type="button" class="button outlined" onClick={() => (dialog.value = 'model')}>
          {t`Settings`}
        </button>
      )}
    </div>
  );
}
