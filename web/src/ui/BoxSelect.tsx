// A box that is drawn in the view with Shift: selects the parts whose middle lies in it, seen or not.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { document, selectAll, selected } from '../session/session';
import { standIns } from '../session/several';
import { stage } from './view';

const dragThreshold = 5; // CSS pixels

interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** @param canvas whose drags with Shift draw the box, in place of turning the view */
export function BoxSelect({ canvas }: { canvas: { readonly current: HTMLCanvasElement | null } }) {
  const box = useSignal<Box | null>(null);
  useEffect(() => {
    const element = canvas.current;
    if (element === null) return;
    let from: { x: number; y: number } | null = null;
    const end = () => {
      from = null;
      box.value = null;
      const rig = stage.peek()?.rig;
      if (rig) rig.enabled = true;
    };
    const onDown = (event: PointerEvent) => {
      const rig = stage.peek()?.rig;
      if (!event.shiftKey || event.button !== 0 || !rig) return;
      from = { x: event.clientX, y: event.clientY };
      rig.enabled = false; // before the camera hears of it
      element.setPointerCapture(event.pointerId);
    };
    const onMove = (event: PointerEvent) => {
      if (from === null) return;
      const [width, height] = [Math.abs(event.clientX - from.x), Math.abs(event.clientY - from.y)];
      if (box.peek() === null && Math.hypot(width, height) <= dragThreshold) return;
      box.value = { left: Math.min(event.clientX, from.x), top: Math.min(event.clientY, from.y), width, height };
    };
    const onUp = () => {
      if (box.peek() !== null) select(box.peek() as Box);
      end();
    };
    element.addEventListener('pointerdown', onDown, { capture: true });
    element.addEventListener('pointermove', onMove);
    element.addEventListener('pointerup', onUp);
    element.addEventListener('pointercancel', end);
    return () => {
      element.removeEventListener('pointerdown', onDown, { capture: true });
      element.removeEventListener('pointermove', onMove);
      element.removeEventListener('pointerup', onUp);
      element.removeEventListener('pointercancel', end);
    };
  }, [canvas, box]);
  if (box.value === null) return null;
  const { left, top, width, height } = box.value;
  return (
    <div
      class="box-select"
      aria-hidden="true"
      style={{ translate: `${left}px ${top}px`, width: `${width}px`, height: `${height}px` }}
    />
  );
}

/** Adds what is in the box to the selection. */
function select({ left, top, width, height }: Box): void {
  const on = stage.peek();
  const { model, hidden } = document.peek();
  if (!on || model === null || on.corners.length === 0) return;
  const inside = model.shape.parts.flatMap(({ id, virtual }, i) => {
    if (virtual || hidden.has(id)) return [];
    const { x, y } = on.projectMean(on.corners.subarray(i * 24, i * 24 + 24));
    return x >= left && x <= left + width && y >= top && y <= top + height ? [id] : [];
  });
  selectAll([...new Set([...selected.peek(), ...standIns(model.shape, inside)])]);
}
