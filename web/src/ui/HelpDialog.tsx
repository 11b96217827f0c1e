// The keyboard sheet, and what this is.
import { m, type Sentence, t } from '../texts/texts';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { Licences } from './Licences';
import { rich } from './rich';

const keys: readonly (readonly [keys: string | Sentence, what: Sentence])[] = [
  [m`Drag, right-drag, wheel`, m`turn, move, zoom`],
  [m`Drag a handle`, m`pull a face of the selected part, or move it; with Alt one side only; Escape leaves it`],
  [m`Arrows on a handle`, m`the same by keyboard; Enter keeps it`],
  ['F', m`bring the selected part, or everything, into view`],
  ['1 · 3 · 7', m`front, side, top view`],
  [m`Shift+click, Shift+drag`, m`select several parts; Ctrl+A selects all`],
  [m`H · I · Alt+H`, m`hide what is selected, show only that, show all`],
  [m`Arrows in the list`, m`from part to part; with Shift they select; right and left unfold and fold a row`],
  ['S · R', m`stop at whole centimetres while dragging; a ruler between two points`],
  ['E', m`parts apart, parts together`],
  [m`Escape`, m`let go of the selection`],
  [m`Space`, m`animate the last edit`],
  [m`Ctrl+Z · Ctrl+Shift+Z`, m`undo, redo`],
  [m`Ctrl+O · Ctrl+S`, m`open, save the session`],
  [m`Arrows on the view`, m`turn it; + and − zoom`],
  [m`Arrows on a slider`, m`one step; with Shift ten, with Alt a tenth`],
  [m`Double-click on a slider`, m`back to the model as it was`],
];

export function HelpDialog() {
  return (
    <Dialog
      title={t`Keyboard and help`}
      onClose={() => {
        dialog.value = null;
      }}
    >
      <p>
        {t`Pick a part, say how it changes, and the other parts follow so that what is joined stays joined and what is symmetric stays symmetric. How much is the slider's.`}
      </p>
      <dl class="keys">
        {keys.map(([combination, what]) => (
          <div key={what}>
            <dt>{typeof combination === 'string' ? combination : t(combination)}</dt>
            <dd>{t(what)}</dd>
          </div>
        ))}
      </dl>
      <p class="quiet">
        {rich(
          t`After <a>ParSEL: Parameterized Shape Editing with Language</a>, Ganeshan et al. 2024. Models never leave this machine. When you ask a language model, its provider gets your request and the names, sizes and relations of the parts.`,
          { a: (text) => <a href="https://arxiv.org/abs/2405.20319">{text}</a> },
        )}
      </p>
      <div class="quiet">
        <Licences />
      </div>
    </Dialog>
  );
}
