// The canvas: hover and click on parts, and on their features while an edit is made by hand.

import type { Signal } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import type { LocalTriple, Sign, Vec3 } from '../program/types';
import type { Insets } from '../scene/camera';
import { ruler, setPoint } from '../session/ruler';
import { document, hovered, select, selectAlso, selected, selection } from '../session/session';
import { t } from '../texts/texts';
import { BoxSelect } from './BoxSelect';
import { brightness, mountStage, several, stage } from './view';
import type { FeatureKind } from './words';

const dragThreshold = 5; // CSS pixels
/** Brightness from which a model is lost on the light ground, and below which on the dark one. */
const pale = 0.85;
const deep = 0.25;

interface StageViewProps {
  readonly insets: Insets;
  readonly pickKind: Signal<FeatureKind | null>;
}

/** The feature of a kind that is nearest to a point of the box: the coordinates that are farthest out decide. */
export function nearestFeature(kind: FeatureKind, local: Vec3): LocalTriple {
  const wanted = { whole: 0, face: 1, edge: 2, corner: 3 }[kind];
  const order = [0, 1, 2].sort((a, b) => Math.abs(local[b] ?? 0) - Math.abs(local[a] ?? 0));
  const feature: [Sign, Sign, Sign] = [0, 0, 0];
  for (const axis of order.slice(0, wanted)) feature[axis] = (local[axis] ?? 0) < 0 ? -1 : 1;
  return feature;
}

export function StageView({ insets, pickKind }: StageViewProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const pressed = useRef<{ x: number; y: number } | null>(null);
  const hoverFrame = useRef(0);
  const hovering = useRef(0); // counts moves: an answer to an earlier one comes too late
  useEffect(() => (canvas.current === null ? undefined : mountStage(canvas.current)), []);

  const { left, right, top, bottom } = insets;
  const model = document.value.model;
  useLayoutEffect(() => {
    stage.value?.setInsets({ left, right, top, bottom });
    if (stage.value?.rig.isFramed) stage.value.fit(null);
  }, [left, right, top, bottom, stage.value]);

  const partAt = async (x: number, y: number) => {
    const hit = (await stage.peek()?.pick(x, y)) ?? null;
    const id = hit && document.peek().model?.shape.parts[hit.part]?.id;
    return hit && id !== undefined && id !== null ? { id, local: hit.local } : null;
  };
  return (
    <>
      <canvas
        ref={canvas}
        class={`stage ${brightness.value > pale ? 'pale' : brightness.value < deep ? 'deep' : ''}`}
        tabIndex={0}
        role="img"
        aria-label={model === null ? t`No model yet` : t`${model.shape.name}, turn with the arrow keys`}
        onPointerDown={(event) => {
          pressed.current = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
        }}
        onPointerUp={async (event) => {
          const start = pressed.current;
          pressed.current = null;
          if (start === null || Math.hypot(event.clientX - start.x, event.clientY - start.y) > dragThreshold) return;
          const adds = event.shiftKey || event.ctrlKey || event.metaKey || several.peek();
          const hit = await partAt(event.clientX, event.clientY);
          if (ruler.peek() !== null) {
            if (hit !== null) setPoint(hit.id, hit.local);
            return;
          }
          const kind = pickKind.peek() ?? 'whole';
          if (adds && hit !== null) selectAlso(hit.id);
          else if (adds) return;
          else if (hit === null) select(null);
          else if (kind !== 'whole') select(hit.id, nearestFeature(kind, hit.local));
          else if (selected.peek().length > 1) select(hit.id);
          else select(selection.peek()?.part === hit.id && pickKind.peek() === null ? null : hit.id);
        }}
        onPointerMove={(event) => {
          if (event.buttons !== 0 || event.pointerType === 'touch') return;
          const { clientX, clientY } = event;
          cancelAnimationFrame(hoverFrame.current);
          const own = ++hovering.current;
          hoverFrame.current = requestAnimationFrame(async () => {
            const hit = await partAt(clientX, clientY);
            if (own === hovering.current) hovered.value = hit?.id ?? null;
          });
        }}
        onPointerLeave={() => {
          cancelAnimationFrame(hoverFrame.current);
          hovering.current++;
          hovered.value = null;
        }}
      />
      <BoxSelect canvas={canvas} />
    </>
  );
}
