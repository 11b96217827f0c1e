// Opening a model: the gallery with thumbnails, files, a folder, an address.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { models } from '../session/core';
import { pickable, readPicked } from '../session/files';
import { type GalleryEntry, loadGallery } from '../session/gallery';
import { openGallery, openUrl } from '../session/open';
import { dialog, openAny } from './actions';
import { Dialog } from './Dialog';
import { thumbnails, thumbnailUrls } from './thumbnails';

const close = () => {
  dialog.value = null;
};

export function OpenDialog() {
  const gallery = useSignal<readonly GalleryEntry[]>([]);
  const address = useSignal('');
  const ready = models.value !== null;
  useEffect(() => {
    let stop = () => {};
    void loadGallery().then((entries) => {
      gallery.value = entries;
      stop = thumbnails(entries.map(({ id }) => id));
    });
    return () => stop();
  }, [gallery]);

  return (
    <Dialog title="Open a model" class="open" onClose={close}>
      <div class="row">
        <FileButton label="Files…" ready={ready} />
        <FileButton label="Folder…" ready={ready} folder />
        <span class="quiet grow">
          .glb, .gltf or .obj with its files, .3mf, .ply, .stl, .zip, .parsel.json. Or drop them anywhere.
        </span>
      </div>
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
          placeholder="Address of a model on this site or this machine"
          aria-label="Address of a model"
          value={address.value}
          onInput={(event) => {
            address.value = event.currentTarget.value;
          }}
        />
        <button type="submit" class="button" disabled={!ready}>
          Open
        </button>
      </form>
      {gallery.value.length > 0 && <h3>Gallery</h3>}
      <ul class="gallery">
        {gallery.value.map(({ id, title }) => (
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
              <span>{title}</span>
            </button>
          </li>
        ))}
      </ul>
    </Dialog>
  );
}

function FileButton({ label, ready, folder = false }: { label: string; ready: boolean; folder?: boolean }) {
  return (
    <label class={`button file ${ready ? '' : 'disabled'}`}>
      {label}
      <input
        type="file"
        class="visually-hidden"
        aria-label={folder ? 'Open a folder' : 'Open files'}
        disabled={!ready}
        multiple
        ref={(input) => {
          if (folder) input?.setAttribute('webkitdirectory', '');
        }}
        accept={folder ? undefined : pickable}
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          if (files.length === 0) return;
          close();
          void openAny(readPicked(files));
        }}
      />
    </label>
  );
}
