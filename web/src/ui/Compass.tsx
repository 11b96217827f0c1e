// Which way the model faces: its four sides on a ring that lies on the ground and turns with the view. Left and right are
// the object's own, as they are in all words here; each side is a button that looks from there. Below it, whose sides a
// request means.

import { useEffect, useRef } from 'preact/hooks';
import { facing } from '../session/facing';
import { sideFacing } from '../session/looking';
import { document } from '../session/session';
import { m, t } from '../texts/texts';
import { SidesSwitch } from './SidesSwitch';
import { stage } from './view';
import { sideName } from './words';

const sides = [
  { view: 'front', letter: m`F@compass`, x: 0, z: 1 },
  { view: 'left', letter: m`L@compass`, x: 1, z: 0 },
  { view: 'back', letter: m`B@compass`, x: 0, z: -1 },
  { view: 'right', letter: m`R@compass`, x: -1, z: 0 },
] as const;

/** CSS pixels, as in style/compass.css. */
const radius = 30;
/** Seen level, the ring is as flat as this. */
const flattest = 0.5;

/** @param right CSS pixels that panels cover on that side */
export function Compass({ right }: { right: number }) {
  const root = useRef<HTMLElement>(null);
  useEffect(() => {
    const on = stage.value;
    if (!on) return;
    const place = () => {
      const element = root.current;
      if (element === null) return;
      const { azimuth, polar } = on.rig.angles;
      facing.value = sideFacing(azimuth);
      const flat = Math.max(flattest, Math.abs(Math.cos(polar)));
      element.style.setProperty('--flat', String(flat));
      for (const [i, { x, z }] of sides.entries()) {
        const across = x * Math.cos(azimuth) - z * Math.sin(azimuth);
        const near = x * Math.sin(azimuth) + z * Math.cos(azimuth);
        const button = element.children[i + 1] as HTMLElement;
        button.style.translate = `${across * radius}px ${near * radius * flat}px`;
        button.style.zIndex = near > 0 ? '1' : '0';
      }
    };
    on.drawn.add(place);
    place();
    return () => void on.drawn.delete(place);
  }, [stage.value, document.value.model]);
  if (document.value.model === null) return null;
  return (
    <section ref={root} class="compass" aria-label={t`Sides of the model`} style={{ right: `${right + 20}px` }}>
      <span class="ring" />
      {sides.map(({ view, letter }) => (
        <button
          key={view}
          type="button"
          class={view === 'front' ? 'front' : ''}
          aria-label={t`Look from its ${sideName(view)}`}
          title={t`Its ${sideName(view)}: a click looks from there. Left and right are the object's own.`}
          onClick={() => stage.peek()?.rig.look(view, true)}
        >
          {t(letter)}
        </button>
      ))}
      <SidesSwitch />
    </section>
  );
}
