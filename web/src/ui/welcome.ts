// What stands on the stage when the page has loaded: the work of a link, or the model that it
// names, else the work of the last visit, else the first
// model of the gallery with an edit that shows itself once.
import { effect } from '@preact/signals';
import { autosave, type Restored } from '../session/autosave';
import { models } from '../session/core';
import { loadGallery } from '../session/gallery';
import type { ModelCore } from '../session/model_core';
import { openGallery, openNamed, openSaved, reopen } from '../session/open';
import { playOnce } from '../session/play';
import { forgetOtherModels } from '../session/requests';
import { document, propagate, say } from '../session/session';
import { readFragment } from '../share/link';
import { isEmbedded } from './frame';
import { keepForOffline } from './update';

/** Call once; answers how to stop listening. */
export function welcome(): () => void {
  let stopSaving = () => {};
  const stopWaiting = effect(() => {
    const core = models.value;
    if (core === null) return;
    queueMicrotask(() => {
      stopWaiting();
      void begin(core).finally(() => {
        if (isEmbedded) return;
        stopSaving = autosave.start();
        void keepForOffline();
      });
    });
  });
  const onHashChange = () => {
    const core = models.peek();
    if (core) void openFragment(core).then((fault) => fault && say(fault, 'error'));
  };
  addEventListener('hashchange', onHashChange);
  const stopForgetting = forgetOtherModels();
  return () => {
    stopForgetting();
    stopWaiting();
    stopSaving();
    removeEventListener('hashchange', onHashChange);
  };
}

/**
 * Opens the work of a link. The fragment is taken out of the address: it describes a moment, not the page.
 * @returns null when there was a link and it was opened, else what is wrong with it; empty when there was none
 */
async function openFragment(core: ModelCore): Promise<string | null> {
  const read = await readFragment(location.hash);
  if (read === null) return '';
  if (!isEmbedded) history.replaceState(null, '', location.pathname + location.search);
  if (!read.ok) return read.text;
  await openSaved(core, read);
  return null;
}

/** `?model=ADDRESS`: the model that a link names. Taken out of the address as the fragment is. */
function takeNamed(): string | null {
  const url = new URL(location.href);
  const address = url.searchParams.get('model');
  if (address === null || isEmbedded) return address;
  url.searchParams.delete('model');
  history.replaceState(null, '', url);
  return address;
}

async function begin(core: ModelCore): Promise<void> {
  const named = takeNamed();
  const kept = isEmbedded ? Promise.resolve(null) : autosave.restore();
  const fault = await openFragment(core);
  if (fault === null) return;
  if (fault === '' && named !== null) return openNamed(core, named);
  await beginWithoutLink(core, await kept);
  if (fault !== '') say(fault, 'error'); // last, since opening a model clears what was said before
}

async function beginWithoutLink(core: ModelCore, last: Restored | null): Promise<void> {
  if (last !== null && (await reopen(core, last.files, last.source, last.work))) return;
  const [first] = await loadGallery();
  if (first === undefined || document.peek().model !== null) return;
  if (!(await openGallery(core, first.id))) return;
  const suggestion = first.suggestions.find(({ edit }) => edit !== null);
  if (!suggestion?.edit) return;
  const key = await propagate(core, suggestion.edit, suggestion.request);
  if (key !== null) playOnce(key);
}
