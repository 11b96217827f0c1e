// How much of the view is covered from below: by the composer, however tall it is, and by what else always stands there.

import { signal } from '@preact/signals';
import { useCallback, useRef } from 'preact/hooks';

/** CSS pixels from the bottom of the window up to the highest of what stands there; 0 while nothing does. */
export const coveredBelow = signal(0);

interface Standing {
  /** Custom CSS property of the page that is kept at its height, so that other things leave room for it. */
  readonly property?: string;
  /** What of it, as a selector, only passes by: the view does not make room for that. */
  readonly passing?: string;
}

const standing = new Map<Element, Standing>();
const observer = new ResizeObserver(measure);
addEventListener('resize', measure);

/** Measures anew: to be called when something may have moved them without changing their sizes. */
export function measure(): void {
  for (const [element, { property }] of standing)
    if (property !== undefined) page().setProperty(property, `${element.getBoundingClientRect().height}px`);
  const reaches = [...standing].map(([element, { passing }]) => {
    const passes = passing === undefined ? undefined : element.querySelector(passing)?.getBoundingClientRect().height;
    return innerHeight - element.getBoundingClientRect().top - (passes ?? 0);
  });
  coveredBelow.value = Math.round(Math.max(0, ...reaches));
}

/** A ref of what covers the view from below. */
export function useStandsBelow({ property, passing }: Standing = {}): (element: Element | null) => void {
  const last = useRef<Element | null>(null);
  return useCallback(
    (element: Element | null) => {
      if (last.current !== null) {
        standing.delete(last.current);
        observer.unobserve(last.current);
        if (property !== undefined) page().removeProperty(property);
      }
      last.current = element;
      if (element === null) return;
      standing.set(element, { ...(property && { property }), ...(passing && { passing }) });
      observer.observe(element);
      measure(); // not only before the next frame: a model that comes with it would jump
    },
    [property, passing],
  );
}

const page = () => globalThis.document.documentElement.style;
