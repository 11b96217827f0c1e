// The steps of the tour: a card beside what each is about.

import { useSignal } from '@preact/signals';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { m, type Sentence, t } from '../texts/texts';
import { step } from './tour_state';

interface Step {
  /** What it is about: the first of these that is on the page. */
  readonly at: readonly string[];
  readonly title: Sentence;
  readonly text: Sentence;
}

const steps: readonly Step[] = [
  {
    at: ['.stage'],
    title: m`Click a part, pull a handle`,
    text: m`A dot pulls a face, the middle moves the part. Everything that is joined to it follows while you pull.`,
  },
  {
    at: ['.composer', '.suggestions', '.hand-buttons', '.tabs'],
    title: m`Or say what to change`,
    text: m`In a sentence, in your language. Without a key of a language model, the suggestions show how it works.`,
  },
  {
    at: ['.card', '.side.right', '.tabs'],
    title: m`Every change is a slider`,
    text: m`Drag it, type a length, double-click to go back. Below it stands what the change keeps, and why each part moves.`,
  },
  {
    at: ['.side.left', '.tabs'],
    title: m`The parts`,
    text: m`Select, hide, rename and label them. A selected part tells what holds it and why it moved.`,
  },
  {
    at: ['.bar'],
    title: m`Yours to take`,
    text: m`Undo anything. Share a link with the sliders in it, or export the model with its own names and materials.`,
  },
];

const gap = 12;

export function TourSteps() {
  const box = useRef<HTMLDivElement>(null);
  const next = useRef<HTMLButtonElement>(null);
  const ring = useSignal<Record<'left' | 'top' | 'width' | 'height', string> | null>(null);
  const at = step.value;
  const shown = at === null ? undefined : steps[at];

  useLayoutEffect(() => {
    if (shown === undefined) return;
    const place = () => {
      const target = shown.at.map((selector) => globalThis.document.querySelector(selector)).find(Boolean);
      const card = box.current;
      if (!target || !card) return;
      const isStage = target.matches('.stage');
      const { left, top, right, bottom, width, height } = target.getBoundingClientRect();
      ring.value = isStage
        ? null
        : { left: `${left - 4}px`, top: `${top - 4}px`, width: `${width + 8}px`, height: `${height + 8}px` };
      const middle = isStage ? innerWidth / 2 : (left + right) / 2;
      const beside = width < innerWidth / 2;
      let x = middle - card.offsetWidth / 2;
      let y = isStage ? innerHeight * 0.68 : bottom + gap;
      if (!isStage && beside) {
        x = middle < innerWidth / 2 ? right + gap : left - gap - card.offsetWidth;
        y = top;
      } else if (!isStage && bottom + gap + card.offsetHeight > innerHeight) y = top - gap - card.offsetHeight;
      const keep = (value: number, room: number) => Math.min(Math.max(gap, value), Math.max(gap, room - gap));
      card.style.left = `${keep(x, innerWidth - card.offsetWidth)}px`;
      card.style.top = `${keep(y, innerHeight - card.offsetHeight)}px`;
    };
    place();
    next.current?.focus();
    addEventListener('resize', place);
    return () => removeEventListener('resize', place);
  }, [shown, ring]);

  if (at === null || shown === undefined) return null;
  const go = (to: number) => {
    step.value = to < 0 ? 0 : to < steps.length ? to : null;
  };
  return (
    <>
      {ring.value && <div class="tour-ring" style={ring.value} />}
      <div
        class="panel tour"
        role="dialog"
        aria-label={t`Tour, ${at + 1} of ${steps.length}: ${t(shown.title)}`}
        aria-describedby="tour-text"
        ref={box}
        onKeyDown={(event) => {
          if (event.key === 'Escape') step.value = null;
          else if (event.key === 'ArrowRight') go(at + 1);
          else if (event.key === 'ArrowLeft') go(at - 1);
          else return;
          event.preventDefault();
          event.stopPropagation();
        }}
      >
        <h2>{t(shown.title)}</h2>
        <p id="tour-text">{t(shown.text)}</p>
        <div class="row">
          <span class="quiet grow">{t`${at + 1} of ${steps.length}`}</span>
          {at + 1 < steps.length && (
            <button type="button" class="button" onClick={() => (step.value = null)}>
              {t`Skip`}
            </button>
          )}
          {at > 0 && (
            <button type="button" class="button" onClick={() => go(at - 1)}>
              {t`Back`}
            </button>
          )}
          <button type="button" class="button primary" ref={next} onClick={() => go(at + 1)}>
            {at + 1 < steps.length ? t`Next` : t`Done`}
          </button>
        </div>
      </div>
    </>
  );
}
