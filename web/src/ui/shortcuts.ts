// Keys of the whole page, after Blender's where it has them. Fields keep their own keys.

import { playing, playOn, stop } from '../session/play';
import { cancelPull, pull } from '../session/pull';
import { ruler, toggleRuler } from '../session/ruler';
import { document, isolate, redo, select, selectAll, selected, setHidden, showAll, undo } from '../session/session';
import { realParts } from '../session/several';
import { snap, snapping } from '../session/snapping';
import { dialog, saveSession } from './actions';
import { focusView, stage, toggleApart } from './view';

const isField = (target: EventTarget | null) =>
  target instanceof HTMLElement &&
  target.matches('input:not([type=range], [type=checkbox], [type=radio]), select, textarea');

function onCommand(event: KeyboardEvent): boolean {
  switch (event.key.toLowerCase()) {
    case 'z':
      if (event.shiftKey) redo();
      else undo();
      return true;
    case 'y':
      redo();
      return true;
    case 'o':
      dialog.value = 'open';
      return true;
    case 's':
      if (document.peek().model) saveSession();
      return true;
    case 'a': {
      const parts = document.peek().model?.shape.parts ?? [];
      const inner = new Set(parts.flatMap(({ members }) => members));
      selectAll(parts.filter(({ id }) => !inner.has(id)).map(({ id }) => id));
      return true;
    }
    default:
      return false;
  }
}

function onPlain(event: KeyboardEvent): boolean {
  const ids = selected.peek();
  const shape = document.peek().model?.shape;
  switch (event.key) {
    case 'f':
    case 'F':
      focusView();
      return true;
    case '1':
      stage.peek()?.rig.look('front', true);
      return true;
    case '3':
      stage.peek()?.rig.look('left', true);
      return true;
    case '7':
      stage.peek()?.rig.look('top', true);
      return true;
    case 's':
    case 'S':
      snap(!snapping.peek());
      return true;
    case 'r':
    case 'R':
      toggleRuler();
      return true;
    case 'h':
    case 'H': {
      if (shape === undefined || ids.length === 0) return false;
      setHidden(realParts(shape, ids), true);
      select(null);
      return true;
    }
    case 'i':
    case 'I':
      if (ids.length === 0) return false;
      isolate(ids);
      return true;
    case 'e':
    case 'E':
      toggleApart();
      return true;
    case '?':
      dialog.value = 'help';
      return true;
    case 'Escape':
      if (pull.peek() !== null) cancelPull();
      else if (playing.peek() !== null) stop();
      else if (ruler.peek() !== null) toggleRuler();
      else select(null);
      return true;
    case ' ': {
      if ((event.target as Element).closest('button, summary, input, a')) return false;
      const last = document.peek().layers.findLast(({ enabled }) => enabled);
      if (playing.peek() !== null) stop();
      else if (last) playOn(last.key);
      return true;
    }
    default:
      return false;
  }
}

/** Keys while the view has the focus: what the pointer does otherwise. */
function onView(event: KeyboardEvent): boolean {
  const rig = stage.peek()?.rig;
  const turns: Record<string, [number, number]> = {
    ArrowLeft: [-0.15, 0],
    ArrowRight: [0.15, 0],
    ArrowUp: [0, -0.15],
    ArrowDown: [0, 0.15],
  };
  const turn = turns[event.key];
  if (turn) rig?.turn(...turn);
  else if (event.key === '+' || event.key === '=') rig?.zoom(0.85);
  else if (event.key === '-') rig?.zoom(1 / 0.85);
  else return false;
  return true;
}

function onKeyDown(event: KeyboardEvent): void {
  if (event.defaultPrevented || dialog.peek() !== null) return;
  const command = event.ctrlKey || event.metaKey;
  if (isField(event.target)) return;
  const isView = event.target instanceof HTMLCanvasElement;
  let done: boolean;
  if (command) done = !event.altKey && onCommand(event);
  else if (event.altKey) {
    done = event.code === 'KeyH';
    if (done) showAll();
  } else done = (isView && onView(event)) || onPlain(event);
  if (done) event.preventDefault();
}

export function listenForShortcuts(): () => void {
  addEventListener('keydown', onKeyDown);
  return () => removeEventListener('keydown', onKeyDown);
}
