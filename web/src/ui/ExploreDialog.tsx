// Nine siblings of the model to choose from: every slider somewhere in its range.

import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { checkProgram } from '../program/check';
import { compileProgram } from '../program/compile';
import { copyOf, type Picture } from '../scene/pictures';
import { programOf } from '../session/document';
import { activeLayers } from '../session/evaluation';
import { document, notice, task } from '../session/session';
import { drawSiblings, type Sibling, takeSibling } from '../session/siblings';
import { t } from '../texts/texts';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { canvasOf, paint } from './pictures';

const count = 9;
const size = 320; // pixels

interface Drawn {
  readonly sibling: Sibling;
  /** Address of its picture. */
  readonly url: string;
}

async function draw(): Promise<readonly Drawn[] | null> {
  const siblings = await drawSiblings(count);
  const { model } = document.peek();
  if (siblings === null || model === null) return null;
  const layers = activeLayers(document.peek());
  const checked = checkProgram(programOf(model.shape, layers), model.shape);
  if (!checked.ok) return null;
  const evaluator = compileProgram(checked.value, model.shape);
  const pictures = siblings.map(({ values }): Picture => {
    evaluator.evaluate(layers.map(({ key }) => values.get(key) ?? 0));
    return { state: copyOf(evaluator), canvas: canvasOf(size, size) };
  });
  if (paint(model, pictures) === null) return null;
  return siblings.map((sibling, i) => ({ sibling, url: pictures[i]?.canvas.toDataURL() ?? '' }));
}

export function ExploreDialog() {
  const drawn = useSignal<readonly Drawn[]>([]);
  const isDrawing = useSignal(false);
  const more = async () => {
    isDrawing.value = true;
    const next = await draw();
    if (next !== null) drawn.value = next;
    isDrawing.value = false;
  };
  useEffect(() => void more(), []);
  const close = () => {
    task.peek()?.cancel();
    dialog.value = null;
  };
  const fault = notice.value?.kind === 'error' ? notice.value.text : '';
  return (
    <Dialog title={t`Siblings`} class="explore" onClose={close}>
      <p class="quiet">
        {t`Every slider somewhere in its range, where all of them go together. Click the one you like.`}
      </p>
      <ul class="siblings" aria-busy={isDrawing.value}>
        {drawn.value.map(({ sibling, url }, i) => (
          <li key={url}>
            <button
              type="button"
              aria-label={t`Sibling ${i + 1}`}
              onClick={() => {
                takeSibling(sibling);
                close();
              }}
            >
              <img src={url} alt="" />
            </button>
          </li>
        ))}
      </ul>
      <p role="status" class={fault === '' ? 'quiet' : 'broken'}>
        {isDrawing.value ? t`Looking for settings that go together…` : fault}
      </p>
      <div class="row">
        <button type="button" class="button primary" disabled={isDrawing.value} onClick={() => void more()}>
          {t`Nine others`}
        </button>
      </div>
    </Dialog>
  );
}
