// Where a model goes in: dropped, or picked. What a good model is stands beside it.
import { models } from '../session/core';
import { pickable, readPicked } from '../session/files';
import { openAny } from './actions';
import { Icon } from './Icon';

/** @param onPicked called when files have been picked, before they are read */
export function DropZone({ onPicked }: { onPicked: () => void }) {
  return (
    <div class="drop-zone">
      <Icon name="open" />
      <p class="grow">
        <strong>Drop a model anywhere on this page</strong>
        <span class="quiet">.glb, .gltf or .obj with its files, .3mf, .ply, .stl, .scad, .csg, .zip, .parsel.json</span>
      </p>
      <FileButton label="Files…" onPicked={onPicked} />
      <FileButton label="Folder…" folder onPicked={onPicked} />
    </div>
  );
}

export function GoodModel() {
  return (
    <p class="quiet good-model">
      A good model has <strong>separate parts</strong> (seat, legs and back as meshes of their own), which{' '}
      <strong>touch</strong> where they are joined, and <strong>names</strong> that say what they are. Furniture,
      shelves, fences, lamps, houses: whatever is put together of pieces. The file stays on this machine.
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
          onPicked();
          void openAny(readPicked(files));
        }}
      />
    </label>
  );
}
