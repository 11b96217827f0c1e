// A link that holds the work, and what whoever opens it will need.

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { document } from '../session/session';
import { linkWarningLength } from '../share/link';
import { t } from '../texts/texts';
import { dialog, saveSession, shareLink } from './actions';
import { Dialog } from './Dialog';

export function ShareDialog() {
  const link = useSignal('');
  const embed = useSignal(false);
  const copied = useSignal(false);
  const field = useRef<HTMLInputElement>(null);
  const source = document.value.model?.source.kind;
  useEffect(() => {
    copied.value = false;
    void shareLink(embed.value).then((text) => {
      link.value = text;
    });
  }, [embed.value, link, copied]);

  const copy = async () => {
    try {
      await navigator.clipboard.writeText(link.value);
      copied.value = true;
    } catch {
      field.current?.select(); // no permission: the text is ready for Ctrl+C
    }
  };
  return (
    <Dialog
      title={t`Share`}
      onClose={() => {
        dialog.value = null;
      }}
    >
      <p>{t`The link holds the edits, their sliders and the view, and no server sees it.`}</p>
      <div class="row">
        <input
          ref={field}
          class="grow"
          readOnly
          value={link.value}
          aria-label={t`Link`}
          onFocus={() => field.current?.select()}
        />
        <button type="button" class="button primary" onClick={copy}>
          {copied.value ? t`Copied` : t`Copy`}
        </button>
      </div>
      <label class="check">
        <input
          type="checkbox"
          checked={embed.value}
          onChange={(event) => {
            embed.value = event.currentTarget.checked;
          }}
        />
        <span>{t`As a viewer with sliders only, for an <iframe>`}</span>
      </label>
      {source === 'file' && (
        <p class="quiet">
          {t`Your model stays with you: whoever opens the link is asked for the file “${document.value.model?.files.name ?? ''}”.`}
        </p>
      )}
      {link.value.length > linkWarningLength && (
        <p class="broken">
          {t`At ${Math.round(link.value.length / 1024)} kB this link is too long for some programs. A file is safer.`}
        </p>
      )}
      <button type="button" class="button" onClick={saveSession}>
        {t`Save as a file instead`}
      </button>
    </Dialog>
  );
}
