// The keyboard sheet, and what this is.
import { dialog } from './actions';
import { Dialog } from './Dialog';

const keys: readonly (readonly [keys: string, what: string])[] = [
  ['Drag, right-drag, wheel', 'turn, move, zoom'],
  ['Drag a handle', 'pull a face of the selected part, or move it; with Alt one side only; Escape leaves it'],
  ['Arrows on a handle', 'the same by keyboard; Enter keeps it'],
  ['F', 'bring the selected part, or everything, into view'],
  ['1 · 3 · 7', 'front, side, top view'],
  ['Shift+click, Shift+drag', 'select several parts; Ctrl+A selects all'],
  ['H · I · Alt+H', 'hide what is selected, show only that, show all'],
  ['Arrows in the list', 'from part to part; with Shift they select; right and left unfold and fold a row'],
  ['S · R', 'stop at whole centimetres while dragging; a ruler between two points'],
  ['E', 'parts apart, parts together'],
  ['Escape', 'let go of the selection'],
  ['Space', 'animate the last edit'],
  ['Ctrl+Z · Ctrl+Shift+Z', 'undo, redo'],
  ['Ctrl+O · Ctrl+S', 'open, save the session'],
  ['Arrows on the view', 'turn it; + and − zoom'],
  ['Arrows on a slider', 'one step; with Shift ten, with Alt a tenth'],
  ['Double-click on a slider', 'back to the model as it was'],
];

/** The build puts both files beside the page. */
export function Licences() {
  return (
    <p>
      Free software, GPL 3 or later:{' '}
      <a href="./licences.txt" target="_blank" rel="noopener">
        licences
      </a>
      ,{' '}
      <a href="./source.tar.gz" download>
        source
      </a>
    </p>
  );
}

export function HelpDialog() {
  return (
    <Dialog
      title="Keyboard and help"
      onClose={() => {
        dialog.value = null;
      }}
    >
      <p>
        Pick a part, say how it changes, and the other parts follow so that what is joined stays joined and what is
        symmetric stays symmetric. How much is the slider's.
      </p>
      <dl class="keys">
        {keys.map(([combination, what]) => (
          <div key={combination}>
            <dt>{combination}</dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <p class="quiet">
        After <a href="https://arxiv.org/abs/2405.20319">ParSEL: Parameterized Shape Editing with Language</a>, Ganeshan
        et al. 2024. Models never leave this machine. When you ask a language model, its provider gets your request and
        the names, sizes and relations of the parts.
      </p>
      <div class="quiet">
        <Licences />
      </div>
    </Dialog>
  );
}
