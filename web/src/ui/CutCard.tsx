// Cutting parts by a plane: across which way, and where, by its slider, by its handle in the view, or by the arrow keys.

import { useSignalEffect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { carveModel } from '../session/carving';
import { models } from '../session/core';
import { cutPlane, cutStep, cutting, endCut, moveCut, turnCut } from '../session/cutting';
import { formatLengths } from '../session/measure';
import { document, selected, task } from '../session/session';
import { plural, t } from '../texts/texts';
import { Icon } from './Icon';
import { useDrawn } from './use_drawn';
import { stage } from './view';

/** In the middle of the page, where the model is. */
export function CutCard() {
  const plane = cutPlane.value;
  const isWrong = cutting.value !== null && (plane === null || cutting.value.shape !== document.value.model?.shape);
  useEffect(() => {
    if (isWrong) endCut(); // another model, or nothing is selected
  }, [isWrong]);
  useSignalEffect(() => {
    const shown = cutPlane.value;
    stage.value?.showSheet(
      shown === null ? null : { origin: shown.origin, normal: shown.direction.normal, reach: shown.reach },
    );
  });
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key === 'Escape' && cutting.peek() !== null) endCut();
    };
    addEventListener('keydown', onKey);
    return () => removeEventListener('keydown', onKey);
  }, []);
  if (plane === null || isWrong) return null;
  const { frame } = cutting.value?.shape ?? { frame: { scale: 1 } };
  const metres = [plane.offset - plane.least, plane.most - plane.offset].map((length) => length * frame.scale);
  const { lengths, unit } = formatLengths(metres, document.value.unit);
  const cut = () => {
    const step = cutStep();
    if (models.value === null || step === null) return;
    endCut();
    void carveModel(models.value, step);
  };
  return (
    <section class="panel note cut-card" aria-label={t`Cut`}>
      <label>
        <span class="quiet">{t`Cut`}</span>
        <select value={plane.direction.id} onChange={(event) => turnCut(event.currentTarget.value)}>
          {plane.directions.map(({ id, label, own = 0 }) => (
            <option key={id} value={id}>
              {t(label, own)}
            </option>
          ))}
        </select>
      </label>
      <input
        type="range"
        min={0.01}
        max={0.99}
        step={0.005}
        value={cutting.value?.share ?? 0.5}
        aria-label={t`Where the cut is`}
        aria-valuetext={t`${lengths[0] ?? ''} and ${lengths[1] ?? ''} ${unit}`}
        onInput={(event) => moveCut(event.currentTarget.valueAsNumber)}
      />
      <span class="quiet">
        {lengths[0]} + {lengths[1]} {unit}
      </span>
      <button type="button" class="button primary" disabled={task.value !== null} onClick={cut}>
        {selected.value.length > 1 ? plural(selected.value.length, 'Cut {n} part', 'Cut {n} parts') : t`Cut`}
      </button>
      <button type="button" class="button" onClick={endCut}>
        {t`Cancel`}
      </button>
    </section>
  );
}

/** On the plane in the view: drags it along its way. */
export function CutHandle() {
  const root = useRef<HTMLButtonElement>(null);
  const pressed = useRef<number | null>(null); // from where the pointer holds it to where it is, in the normalised frame
  const plane = cutPlane.value;
  const place = () => {
    const [on, element, now] = [stage.peek(), root.current, cutPlane.peek()];
    if (!on || element === null || now === null) return;
    const { x, y } = on.projectMean(now.origin);
    element.style.translate = `${x}px ${y}px`;
  };
  useDrawn(place);
  if (plane === null) return null;
  const { origin, direction, least, most, offset } = plane;
  const along = (event: PointerEvent): number =>
    offset + (stage.peek()?.distanceAlong(origin, direction.normal, event.clientX, event.clientY) ?? 0);
  return (
    <div class="handles">
      <button
        ref={root}
        type="button"
        class="handle whole cut"
        aria-label={t`Move the cut`}
        title={t`Drag to move the cut`}
        onPointerDown={(event) => {
          if (event.button !== 0) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          pressed.current = offset - along(event);
        }}
        onPointerMove={(event) => {
          if (pressed.current === null) return;
          moveCut((along(event) + pressed.current - least) / (most - least));
        }}
        onPointerUp={() => {
          pressed.current = null;
        }}
        onPointerCancel={() => {
          pressed.current = null;
        }}
        onKeyDown={(event) => {
          const sign = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
          if (sign === undefined) return;
          event.preventDefault();
          event.stopPropagation();
          moveCut((cutting.peek()?.share ?? 0.5) + (sign * (event.shiftKey ? 10 : 1)) / 100);
        }}
      >
        <Icon name="move" />
      </button>
    </div>
  );
}
