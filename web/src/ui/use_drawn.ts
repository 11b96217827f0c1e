// What lies over the canvas and goes along with the view.
import { useEffect } from 'preact/hooks';
import { stage } from './view';

/** Calls `place` now and whenever the view has been drawn anew, for as long as the component is there. */
export function useDrawn(place: () => void): void {
  useEffect(() => {
    const on = stage.value;
    if (!on) return;
    on.drawn.add(place);
    place();
    return () => void on.drawn.delete(place);
  });
}
