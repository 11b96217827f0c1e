// Handles on the selected part: its faces can be grabbed and pulled, its middle moves it; also an edge or a corner that
// is selected. They are buttons, so that the keyboard pulls as well.

import { useSignal, useSignalEffect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { Axis, LocalTriple } from '../program/types';
import { axisOfDrag } from '../scene/drag';
import { models } from '../session/core';
import { nameOf } from '../session/document';
import { formatMeasure, larger, pointIn } from '../session/measure';
import { playing } from '../session/play';
import { beginPull, cancelPull, endPull, faceNormal, pull, pullBy, pullTo } from '../session/pull';
import { readLayer } from '../session/reading';
import { compiled, document, entryOf, select, selected, selection, sliderValue, step } from '../session/session';
import { standIns } from '../session/several';
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { useDrawn } from './use_drawn';
import { apart, shown, stage } from './view';
import { featureKind, featureWords, listWords } from './words';

const faces: readonly LocalTriple[] = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
];
const whole: LocalTriple = [0, 0, 0];
const dragThreshold = 4; // CSS pixels

interface Point {
  readonly x: number;
  readonly y: number;
}

/** On a thin part the handles of its large faces would hide the one in its middle. */
const leastDistance = matchMedia('(pointer: coarse)').matches ? 48 : 36; // CSS pixels

function awayFrom(middle: Point, at: Point): Point {
  const [x, y] = [at.x - middle.x, at.y - middle.y];
  const distance = Math.hypot(x, y);
  if (distance >= leastDistance) return at;
  if (distance < 1) return { x: middle.x, y: middle.y - leastDistance };
  return { x: middle.x + (x * leastDistance) / distance, y: middle.y + (y * leastDistance) / distance };
}

const isSame = (a: LocalTriple, b: LocalTriple) => a.join() === b.join();

export function Handles() {
  const root = useRef<HTMLDivElement>(null);
  const { model, hidden } = document.value;
  const [id, ...also] = model === null ? [] : standIns(model.shape, selected.value);
  const part = model?.shape.parts.findIndex((other) => other.id === id) ?? -1;
  const picked = selection.value?.feature ?? whole;
  const ids = model?.shape.parts[part]?.members ?? [];
  const isHidden = id !== undefined && (ids.length > 0 ? ids : [id]).every((member) => hidden.has(member));
  const rests =
    part < 0 || isHidden || apart.value > 0 || playing.value !== null || shown.value !== model?.shape || !models.value;
  const extra = ['edge', 'corner'].includes(featureKind(picked)) ? [picked] : [];
  const features = rests ? [] : [whole, ...faces, ...extra];

  const place = () => {
    const on = stage.peek();
    if (!on || on.corners.length === 0) return;
    const middle = on.projectMean(pointIn(on.corners, part, whole));
    for (const button of root.current?.children ?? []) {
      const feature = (button as HTMLElement).dataset.feature?.split(',').map(Number) as unknown as LocalTriple;
      const point = pointIn(on.corners, part, feature);
      const isFace = featureKind(feature) === 'face';
      const isBehind = isFace && !on.isFacing(point, faceNormal(on.corners, part, feature));
      const { x, y } = isFace ? awayFrom(middle, on.projectMean(point)) : on.projectMean(point);
      Object.assign((button as HTMLElement).style, {
        translate: `${x}px ${y}px`,
        visibility: isBehind && pull.peek() === null ? 'hidden' : 'visible',
      });
      const reading = button.querySelector<HTMLElement>('.pull-reading');
      if (reading) {
        const room = reading.offsetWidth / 2 + 8;
        reading.style.translate = `${Math.min(innerWidth - room, Math.max(room, x)) - x}px`;
      }
    }
  };
  useDrawn(place);
  useSignalEffect(() => {
    const held = pull.value;
    const at = held && model ? model.shape.parts.findIndex((other) => other.id === held.grab.part) : -1;
    const corners = stage.peek()?.corners;
    stage
      .peek()
      ?.guide(
        held && corners && at >= 0 ? { from: pointIn(corners, at, held.grab.feature), axis: held.direction } : null,
      );
  });
  // A selection that goes, or a part that is hidden, ends what was begun on it.
  useEffect(() => (rests ? undefined : () => cancelPull()), [rests, id]);

  return (
    <div class={`handles ${pull.value ? 'pulling' : ''}`} ref={root}>
      {features.map((feature) => (
        <Handle
          key={feature.join()}
          part={part}
          id={id ?? ''}
          also={also}
          feature={feature}
          isSelected={isSame(feature, picked)}
        />
      ))}
    </div>
  );
}

interface HandleProps {
  readonly part: number;
  readonly id: string;
  /** Other parts that are pulled with it. */
  readonly also: readonly string[];
  readonly feature: LocalTriple;
  readonly isSelected: boolean;
}

function Handle({ part, id, also, feature, isSelected }: HandleProps) {
  const pressed = useRef<{ x: number; y: number; from: number; moving: boolean } | null>(null);
  const latest = useRef<Point>({ x: 0, y: 0 });
  const dragged = useRef(false); // the click that follows is not one
  const kind = featureKind(feature);
  const name = nameOf(document.value, id);
  const what = kind === 'whole' ? name : t`${featureWords(feature)} of ${name}`;
  const held = pull.value !== null && pull.value.grab.part === id && isSame(pull.value.grab.feature, feature);

  const begin = (axis: Axis, oneSided: boolean) => {
    const core = models.peek();
    if (core === null) return Promise.resolve(false);
    const names = listWords([id, ...also].map((one) => nameOf(document.peek(), one)));
    const request = kind === 'whole' ? t`Move ${names}` : t`Pull ${t`${featureWords(feature)} of ${names}`}`;
    return beginPull(core, { part: id, also, feature, axis, oneSided }, request);
  };
  const along = ({ x, y }: Point) => {
    const direction = pull.peek()?.direction;
    return direction ? (stage.peek()?.distanceAlong(origin.current, direction, x, y) ?? 0) : 0;
  };
  const origin = useRef<readonly [number, number, number]>([0, 0, 0]);

  const start = (event: PointerEvent, from: Point) => {
    const on = stage.peek();
    if (!on) return;
    origin.current = pointIn(on.corners, part, feature);
    const moved = { x: event.clientX - from.x, y: event.clientY - from.y };
    const axis = axisOfDrag((points) => on.projectMean(points), origin.current, moved);
    void begin(axis, event.altKey).then((ready) => {
      if (!ready) return;
      const zero = along(from);
      pullTo(along(latest.current) - zero);
      if (pressed.current) pressed.current.from = zero;
      else endPull(); // the hand let go before the core had answered
    });
  };

  return (
    <button
      type="button"
      class={`handle ${kind} ${isSelected ? 'selected' : ''} ${held ? 'held' : ''}`}
      data-feature={feature.join()}
      aria-label={kind === 'whole' ? t`Move ${what}` : t`Pull ${what}`}
      title={
        kind === 'whole'
          ? t`Drag to move`
          : kind === 'face'
            ? t`Drag to pull the ${featureWords(feature)}; with Alt this side only`
            : t`Drag to pull the ${featureWords(feature)}`
      }
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        pressed.current = { x: event.clientX, y: event.clientY, from: 0, moving: false };
      }}
      onPointerMove={(event) => {
        const press = pressed.current;
        latest.current = { x: event.clientX, y: event.clientY };
        if (press === null) return;
        if (!press.moving && Math.hypot(event.clientX - press.x, event.clientY - press.y) > dragThreshold) {
          press.moving = true;
          start(event, press);
        } else if (press.moving && pull.peek()?.layer) pullTo(along(latest.current) - press.from);
      }}
      onPointerUp={() => {
        const press = pressed.current;
        pressed.current = null;
        dragged.current = press?.moving ?? false;
        if (dragged.current && pull.peek()?.layer) endPull();
      }}
      onClick={() => {
        if (!dragged.current && also.length === 0) select(id, isSelected ? whole : feature);
        dragged.current = false;
      }}
      onPointerCancel={() => {
        pressed.current = null;
        cancelPull();
      }}
      onKeyDown={(event) => {
        if (event.key === 'Enter' && held) endPull();
        else if (!onArrow(event, kind === 'face', held, begin)) return;
        event.preventDefault();
        event.stopPropagation();
      }}
      onBlur={() => {
        if (held && pressed.current === null) endPull();
      }}
    >
      {kind === 'whole' && <Icon name="move" />}
      {held && <Reading />}
    </button>
  );
}

/** Arrows pull: a face outwards and inwards, all else along the axis of the arrow; with Shift ten steps. */
function onArrow(
  event: KeyboardEvent,
  isFace: boolean,
  held: boolean,
  begin: (axis: Axis, oneSided: boolean) => Promise<boolean>,
): boolean {
  const arrows: Record<string, readonly [axis: Axis, sign: 1 | -1]> = {
    ArrowRight: [0, 1],
    ArrowLeft: [0, -1],
    ArrowUp: [1, 1],
    ArrowDown: [1, -1],
    PageUp: [2, -1],
    PageDown: [2, 1],
  };
  const arrow = arrows[event.key];
  if (arrow === undefined) return false;
  const [axis, sign] = arrow;
  const steps = sign * (event.shiftKey ? 10 : 1);
  const now = pull.peek();
  if (held && (isFace || now?.grab.axis === axis)) {
    pullBy(steps);
    return true;
  }
  if (held) endPull();
  void begin(axis, event.altKey).then((ready) => {
    if (ready) pullBy(steps);
  });
  return true;
}

/** What the hand changes, beside it. */
function Reading() {
  const text = useSignal('');
  useSignalEffect(() => {
    step.value; // reads the evaluator below, which is no signal
    const layer = pull.value?.layer;
    const state = compiled.value;
    if (!layer || state.kind !== 'ready') {
      text.value = '…';
      return;
    }
    const entry = entryOf(layer.key);
    const value = entry ? sliderValue(entry) : layer.start;
    const atEnd = value <= layer.min || value >= layer.max;
    const now = entry && layer.measure ? (readLayer(entry, layer.measure, [value])[0] ?? 0) : 0;
    const like = larger(layer.before, now);
    const show = (length: number) =>
      layer.measure ? formatMeasure(layer.measure.what, length, like, document.peek().unit) : '';
    const reading = layer.measure ? `${show(layer.before)} → ${show(now)}` : '';
    text.value = atEnd ? `${reading} · ${t`as far as it goes`}` : reading;
  });
  return (
    <span class="pull-reading" role="status">
      {text.value}
    </span>
  );
}
