// Opening a model: the gallery with thumbnails, files, a folder, an address.

import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { models } from '../session/core';
import { type GalleryEntry, loadGallery, loadNameless, loadPrograms } from '../session/gallery';
import { modelHosts } from '../session/model_hosts';
import { openGallery, openUrl } from '../session/open';
import { t } from '../texts/texts';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { DropZone, GoodModel } from './DropZone';
import { thumbnails, thumbnailUrls } from './thumbnails';

const close = () => {
  dialog.value = null;
};

export function OpenDialog() {
  const gallery = useSignal<readonly GalleryEntry[]>([]);
  const programs = useSignal<readonly GalleryItem[]>([]);
  const nameless = useSignal<readonly GalleryItem[]>([]);
  const address = useSignal('');
  const ready = models.value !== null;
  useEffect(() => {
    let stop: (() => void) | null = null;
    let isClosed = false;
    void Promise.all([loadGallery(), loadPrograms(), loadNameless()]).then(([entries, cad, bare]) => {
      if (isClosed) return; // a file was quicker: nobody sees the pictures, and drawing them takes a while
      gallery.value = entries;
      programs.value = cad;
      nameless.value = bare;
      stop = thumbnails([...entries, ...cad, ...bare].map(({ id }) => id));
    });
    return () => {
      isClosed = true;
      stop?.();
    };
  }, [gallery, programs, nameless]);

  return (
    <Dialog title={t`Open a model`} class="open" onClose={close}>
      <DropZone onPicked={close} />
      <GoodModel />
      <form
        class="row"
        onSubmit={(event) => {
          event.preventDefault();
          if (models.value === null || address.value.trim() === '') return;
          close();
          void openUrl(models.value, address.value.trim());
        }}
      >
        <input
          class="grow"
          type="text"
          inputMode="url"
          placeholder={t`Address of a model: ${[...modelHosts, t`this site`, t`this machine`].join(', ')}`}
          aria-label={t`Address of a model`}
          value={address.value}
          onInput={(event) => {
            address.value = event.currentTarget.value;
          }}
        />
        <button type="submit" class="button" disabled={!ready}>
          {t`Open`}
        </button>
      </form>
      <Gallery title={t`Gallery`} entries={gallery.value} ready={ready} />
      <Gallery title={t`OpenSCAD programs, each with its kinds`} entries={programs.value} ready={ready} />
      <Gallery title={t`Models without names, as most are`} entries={nameless.value} ready={ready} />
    </Dialog>
  );
}

type GalleryItem = Pick<GalleryEntry, 'id' | 'title'>;

function Gallery({ title, entries, ready }: { title: string; entries: readonly GalleryItem[]; ready: boolean }) {
  if (entries.length === 0) return null;
  return (
    <>
      <h3>{title}</h3>
      <ul class="gallery">
        {entries.map(({ id, title: name }) => (
          <li key={id}>
            <button
              type="button"
              disabled={!ready}
              onClick={() => {
                if (models.value === null) return;
                close();
                void openGallery(models.value, id);
              }}
            >
              <span class="thumbnail">
                {thumbnailUrls.value.has(id) && <img src={thumbnailUrls.value.get(id) ?? ''} alt="" />}
              </span>
              <span>{name}</span>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}
