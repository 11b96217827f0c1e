// Where a model goes in: dropped, or picked. What a good model is stands beside it.

import { models } from '../session/core';
import { pickable, readPicked } from '../session/files';
import { t } from '../texts/texts';
import { openAny } from './actions';
import { Icon } from './Icon';
import { rich } from './rich';

/** @param onPicked called when files have been picked, before they are read */
export function DropZone({ onPicked }: { onPicked: () => void }) {
  return (
    <div class="drop-zone">
      <Icon name="open" />
      <p class="grow">
        <strong>{t`Drop a model anywhere on this page`}</strong>
        <span class="quiet">
          {t`.glb, .gltf or .obj with its files, .3mf, .ply, .stl, .scad, .csg, .zip, .parsel.json`}
        </span>
      </p>
      <FileButton label={t`Files…`} onPicked={onPicked} />
      <FileButton label={t`Folder…`} folder onPicked={onPicked} />
    </div>
  );
}

export function GoodModel() {
  return (
    <p class="quiet good-model">
      {rich(
        t`A good model has <b>separate parts</b> (seat, legs and back as meshes of their own), which <b>touch</b> where they are joined, and <b>names</b> that say what they are. Furniture, shelves, fences, lamps, houses: whatever is put together of pieces. The file stays on this machine.`,
        { b: (text) => <strong>{text}</strong> },
      )}
    </p>
  );
}

function FileButton({ label, folder = false, onPicked }: { label: string; folder?: boolean; onPicked: () => void }) {
  const ready = models.value !== null;
  return (
    <label class={`button file ${ready ? '' : 'disabled'}`}>
      {label}
      <input
        type="file"
        class="visually-hidden"
        aria-label={folder ? t`Open a folder` : t`Open files`}
        disabled={!ready}
        multiple
        ref={(input) => {
          if (folder) input?.setAttribute('webkitdirectory', '');
        }}
        accept={folder ? undefined : pickable}
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          if (files.length === 0) return;
          onPicked();
          void openAny(readPicked(files));
        }}
      />
    </label>
  );
}
